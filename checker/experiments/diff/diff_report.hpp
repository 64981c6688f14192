// A comparison of two profiles as people and machines read it.
#pragma once

#include <map>
#include <string>

#include <nlohmann/json_fwd.hpp>

#include "checker/experiments/diff/diff.hpp"
#include "checker/presentation/document/document.hpp"
#include "checker/presentation/json/schema_form.hpp"

namespace stormproof::diff {

/// Files that were written beside the report, by what they show: "telling-apart.base", property id.
using Files = std::map<std::string, std::string, std::less<>>;

/// With findings: one test case for each property, configuration and margin; regressions point at
/// the changed knobs in the candidate's file.
[[nodiscard]] report::Document document_of(const DiffReport& report, const Files& files);
/// specs/guide/output.md describes the keys.
[[nodiscard]] nlohmann::ordered_json to_json(const DiffReport& report, const Files& files);
[[nodiscard]] nlohmann::ordered_json json_schema(report::SchemaDefinitions& definitions);

}  // namespace stormproof::diff
