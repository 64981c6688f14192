// The JSON Schema of what a verb prints, put together from the forms that its JSON has.
#pragma once

#include <string>
#include <vector>

#include <nlohmann/json_fwd.hpp>

namespace stormproof::report {

class SchemaDefinitions;

/// Usually one `schema_form<T>` (schema.hpp).
using SchemaForm = nlohmann::ordered_json (*)(SchemaDefinitions&);

/// Draft 2020-12, with what the forms define. At least one form.
[[nodiscard]] nlohmann::ordered_json schema_of(const std::string& title,
                                               const std::vector<SchemaForm>& forms);

}  // namespace stormproof::report
