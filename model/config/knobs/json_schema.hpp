// JSON Schema (draft 7) of scenario files and profiles, generated from the knob tables, so that
// editors complete and check them while they are written. `specs/schema` holds the generated files;
// a test keeps them up to date.
#pragma once

#include <string>

namespace stormproof::model::config {

enum class SchemaKind { scenario, dds, wireless };

/// The file under `specs/schema`: "scenario.schema.json", …
[[nodiscard]] std::string schema_file_name(SchemaKind kind);

/// The text of that file, with a final newline.
[[nodiscard]] std::string json_schema(SchemaKind kind);

}  // namespace stormproof::model::config
