// Each property is a rule of SARIF and a test case of JUnit, at the line of the user's file that
// sets the knob it is about.
#include "checker/verification/check/check_findings.hpp"

#include <fmt/core.h>

#include "checker/presentation/text/command_line.hpp"
#include "checker/verification/check/origins.hpp"
#include "model/implementations.hpp"

namespace stormproof::checker {

namespace {

/// The other knobs of the property that the user set.
std::vector<report::Location> related_to(std::string_view property, const CheckContext& context,
                                         const report::Location& chosen) {
  std::vector<report::Location> related;
  const std::string file = scenario_file(context.places, context.name);
  for (const std::string_view key : knobs_of(property)) {
    const auto place = context.places.find(key);
    if (place == context.places.end() || !by_user(place->second, file)) continue;
    if (key != chosen.message) related.emplace_back(place->second, std::string{key});
  }
  return related;
}

report::Finding::Outcome outcome_of(Standing standing) {
  using Outcome = report::Finding::Outcome;
  switch (standing) {
    case Standing::fails:
      return Outcome::failed;
    case Standing::open:
      return Outcome::unknown;
    case Standing::disputed:
      return Outcome::disputed;
    case Standing::possible:
    case Standing::unknown:
    case Standing::accepted:
      return Outcome::note;
    case Standing::holds:
      break;
  }
  return Outcome::passed;
}

}  // namespace

report::Finding outlook_finding(const CheckReport& report, const CheckContext& context) {
  report::Finding one;
  one.id = context.gate.outlook_id;
  one.group = "stormproof." + context.name;
  one.statement = one.id == storm_id
                      ? "Discovery is no storm: repeats that nobody lacks do not take the channel."
                      : std::string{props::find_property(incomplete_id)->statement};
  one.outcome = outcome_of(context.gate.outlook);
  one.word = name_of(context.gate.outlook);
  one.message = report.outlook->headline() + ": " + report.outlook->sentence();
  one.locations.push_back(location_of(one.id, context.places, context.name));
  one.identity = {context.name, one.word};
  return one;
}

report::Finding ci_finding(const PropertyResult& result, Standing standing,
                           const CheckContext& context) {
  using Outcome = report::Finding::Outcome;
  report::Finding one;
  one.id = result.property->id;
  one.group = "stormproof." + context.name;
  one.statement = statement_of(*result.property, model::kind_of(context.scenario.dds));
  one.description = one.statement;
  if (!result.property->assumptions.empty()) {
    one.description += fmt::format(" Claimed under: {}.", result.property->assumptions);
  }
  one.outcome = outcome_of(standing);
  one.word = name_of(result.verdict);
  const props::Counterexample* counterexample = result.counterexample();
  one.message = counterexample == nullptr ? result.decisive().how : counterexample->reason;
  for (const props::Finding& finding : result.findings) {
    one.seconds += finding.seconds;
    one.details += fmt::format("{}: {}: {}\n", finding.engine, name_of(finding.kind), finding.how);
    for (const std::string& line : finding.assumptions) {
      one.details += "  assuming " + line + "\n";
    }
  }
  const auto file = context.counterexamples.find(result.property->id);
  if (file != context.counterexamples.end())
    one.command = report::command_line({"replay", file->second});
  one.locations.push_back(location_of(one.id, context.places, context.name));
  if (one.outcome != Outcome::passed) {
    one.related = related_to(one.id, context, one.locations.front());
  }
  one.identity = {context.name, name_of(result.verdict)};
  return one;
}

}  // namespace stormproof::checker
