// A check as a document for people and CI systems, and as JSON.
#pragma once

#include <map>
#include <string>

#include <nlohmann/json_fwd.hpp>

#include "checker/presentation/document/document.hpp"
#include "checker/presentation/json/schema_form.hpp"
#include "checker/verification/check/check.hpp"
#include "checker/verification/check/gate.hpp"
#include "model/config/tree/tree.hpp"

namespace stormproof::checker {

/// What surrounds a report: what was checked, and the files that were written beside it.
struct CheckContext {
  std::string name;  ///< what the user called the scenario
  const model::Scenario& scenario;
  std::map<std::string, std::string, std::less<>> counterexamples;  ///< property id → path
  std::map<std::string, report::Story, std::less<>> stories;        ///< property id → text
  model::config::Places places{};  ///< of the scenario's values; empty if they are not known
  Gate gate{};                     ///< what the verdicts mean for the exit code
  std::string words{};             ///< the scenario with its overrides, for a command line
};

/// The answer, the verdicts, what is violated and why. Pages that are made of it run the scenario
/// and its counterexamples once more, for what they draw.
[[nodiscard]] report::Document document_of(const CheckReport& report, const CheckContext& context);

/// specs/guide/output.md describes the keys.
[[nodiscard]] nlohmann::ordered_json to_json(const CheckReport& report,
                                             const CheckContext& context);
[[nodiscard]] nlohmann::ordered_json check_schema(report::SchemaDefinitions& definitions);

}  // namespace stormproof::checker
