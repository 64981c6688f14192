// A check in the forms that people and machines read: text, JSON, Markdown, HTML, JUnit, SARIF.
#pragma once

#include <map>
#include <string>

#include <nlohmann/json_fwd.hpp>

#include "checker/verification/check/check.hpp"
#include "model/config/provenance.hpp"

namespace stormproof::checker {

/// What surrounds a report: what was checked, and the files that were written beside it.
struct CheckContext {
  std::string name;  ///< what the user called the scenario
  const model::Scenario& scenario;
  std::map<std::string, std::string, std::less<>> counterexamples;  ///< property id → path
  std::map<std::string, std::string, std::less<>> stories;          ///< property id → text
  bool verbose = false;
  model::config::Places places{};  ///< of the scenario's values; empty if they are not known
  std::string command{};           ///< repeats the check; may be empty
  int exit_code = 0;               ///< of the program that prints the report
};

/// One line for each property, then what is violated and why; at most 100 columns wide.
[[nodiscard]] std::string to_text(const CheckReport& report, const CheckContext& context);

/// Keys: scenario, implementation, seconds, interrupted, summary, verdicts. specs/guide/output.md
/// describes them.
[[nodiscard]] nlohmann::ordered_json to_json(const CheckReport& report,
                                             const CheckContext& context);

/// One test case for each property: violated is a failure, inconclusive an error.
[[nodiscard]] std::string to_junit(const CheckReport& report, const CheckContext& context);

/// For a comment on a pull request: what is violated first, details folded away.
[[nodiscard]] std::string to_markdown(const CheckReport& report, const CheckContext& context);

/// One self-contained page. It runs the scenario and its counterexamples once more, for what it
/// draws.
[[nodiscard]] std::string to_html(const CheckReport& report, const CheckContext& context);

/// SARIF 2.1.0. Results point at the knobs in the user's own files.
[[nodiscard]] nlohmann::ordered_json to_sarif(const CheckReport& report,
                                              const CheckContext& context);

}  // namespace stormproof::checker
