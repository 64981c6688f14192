// The logs that diff and conform still make, as findings of a document.
#include <algorithm>

#include <nlohmann/json.hpp>

#include "checker/presentation/document/render.hpp"
#include "checker/presentation/document/sarif.hpp"

namespace stormproof::report {

nlohmann::ordered_json to_json(const SarifLog& log) {
  using Level = SarifResult::Level;
  using Outcome = Finding::Outcome;
  Document document;
  document.exit_code = log.exit_code;
  document.command = log.command;
  document.complete = log.complete;
  for (const SarifResult& result : log.results) {
    Finding& finding = document.findings.emplace_back();
    finding.id = result.rule;
    const auto rule = std::ranges::find(log.rules, result.rule, &SarifRule::id);
    if (rule != log.rules.end()) {
      finding.statement = rule->name;
      finding.description = rule->description;
    }
    finding.outcome = result.level == Level::none   ? Outcome::passed
                      : result.level == Level::note ? Outcome::note
                                                    : Outcome::failed;
    finding.warning = result.level == Level::warning;
    finding.message = result.message;
    finding.locations = result.locations;
    finding.related = result.related;
    finding.identity = result.identity;
  }
  return to_sarif(document);
}

}  // namespace stormproof::report
