// A check as text for a person, as JSON and as JUnit XML for a CI system.
#pragma once

#include <map>
#include <string>

#include <nlohmann/json_fwd.hpp>

#include "checker/check/check.hpp"

namespace stormproof::checker {

/// What surrounds a report: what was checked, and the files that were written beside it.
struct CheckContext {
  std::string name;  ///< what the user called the scenario
  const model::Scenario& scenario;
  std::map<std::string, std::string, std::less<>> counterexamples;  ///< property id → path
  std::map<std::string, std::string, std::less<>> stories;          ///< property id → text
  bool verbose = false;
};

/// One line for each property, then what is violated and why; at most 100 columns wide.
[[nodiscard]] std::string to_text(const CheckReport& report, const CheckContext& context);

/// Keys: scenario, implementation, seconds, interrupted, summary, verdicts. specs/output.md
/// describes them.
[[nodiscard]] nlohmann::ordered_json to_json(const CheckReport& report,
                                             const CheckContext& context);

/// One test case for each property: violated is a failure, inconclusive an error.
[[nodiscard]] std::string to_junit(const CheckReport& report, const CheckContext& context);

}  // namespace stormproof::checker
