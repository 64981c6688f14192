// A comparison of two profiles in the six forms that people and machines read.
#pragma once

#include <map>
#include <string>

#include <nlohmann/json_fwd.hpp>

#include "checker/experiments/diff/diff.hpp"

namespace stormproof::diff {

/// Files that were written beside the report, by what they show: "telling-apart.base", property id.
using Files = std::map<std::string, std::string, std::less<>>;

/// For a person at a terminal; at most 100 columns wide. `verbose`: all measures of all
/// configurations.
[[nodiscard]] std::string to_text(const DiffReport& report, const Files& files,
                                  bool verbose = false);
/// specs/guide/output.md describes the keys.
[[nodiscard]] nlohmann::ordered_json to_json(const DiffReport& report, const Files& files);
/// For a pull-request comment: the judgment first, details folded away.
[[nodiscard]] std::string to_markdown(const DiffReport& report, const Files& files);
/// One self-contained page.
[[nodiscard]] std::string to_html(const DiffReport& report, const Files& files);
/// One test case for each property, configuration and margin: a regression is a failure, what is
/// unclear an error.
[[nodiscard]] std::string to_junit(const DiffReport& report, const Files& files);
/// SARIF 2.1.0: regressions point at the changed knobs in the candidate's file.
[[nodiscard]] nlohmann::ordered_json to_sarif(const DiffReport& report, const Files& files);

}  // namespace stormproof::diff
