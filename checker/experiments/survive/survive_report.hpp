// Everything that a person, a script or another tool gets from a comparison of failures.
#pragma once

#include <string>

#include <nlohmann/json_fwd.hpp>

#include "checker/experiments/survive/survive.hpp"
#include "checker/presentation/document/document.hpp"
#include "checker/presentation/json/schema_form.hpp"

namespace stormproof::survive {

[[nodiscard]] report::Document document_of(const Report& report, const Request& request);
/// specs/guide/survive.md describes the keys.
[[nodiscard]] nlohmann::ordered_json to_json(const Report& report, const Request& request);
[[nodiscard]] nlohmann::ordered_json json_schema(report::SchemaDefinitions& definitions);

/// Recovery over how long somebody is away, with the range of the runs.
[[nodiscard]] std::string to_svg(const Report& report);

}  // namespace stormproof::survive
