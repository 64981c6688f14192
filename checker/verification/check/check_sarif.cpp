// A check as SARIF: one rule for each property, one result for each that does not hold, at the line
// of the user's file that sets the knob it is about.
#include <nlohmann/json.hpp>

#include "checker/presentation/document/sarif.hpp"
#include "checker/presentation/text/assumptions.hpp"
#include "checker/verification/check/check_report.hpp"
#include "checker/verification/check/origins.hpp"

namespace stormproof::checker {

namespace {

using props::VerdictKind;
using report::SarifResult;

SarifResult::Level level_of(VerdictKind kind) {
  switch (kind) {
    case VerdictKind::violated:
      return SarifResult::Level::error;
    case VerdictKind::inconclusive:
      return SarifResult::Level::warning;
    case VerdictKind::proved:
    case VerdictKind::bounded:
    case VerdictKind::sampled:
      return SarifResult::Level::none;
  }
  return SarifResult::Level::warning;
}

std::string message_of(const PropertyResult& result, const CheckContext& context) {
  const std::string id{result.property->id};
  const props::Counterexample* counterexample = result.counterexample();
  const std::string why =
      counterexample == nullptr ? result.decisive().how : counterexample->reason;
  std::string text = id + " is " + name_of(result.verdict) + ": " + why;
  const auto file = context.counterexamples.find(id);
  if (file != context.counterexamples.end()) {
    text += " Replay it: stormproof replay " + file->second;
  }
  return text;
}

/// The other knobs of the property that the user set.
std::vector<report::SarifLocation> related_to(std::string_view property,
                                              const CheckContext& context,
                                              const report::SarifLocation& chosen) {
  std::vector<report::SarifLocation> related;
  const std::string file = scenario_file(context.places, context.name);
  for (const std::string_view key : knobs_of(property)) {
    const auto place = context.places.find(key);
    if (place == context.places.end() || !by_user(place->second, file)) continue;
    if (key != chosen.message) related.emplace_back(place->second, std::string{key});
  }
  return related;
}

SarifResult result_of(const PropertyResult& result, const CheckContext& context) {
  SarifResult one;
  one.rule = result.property->id;
  one.level = level_of(result.verdict);
  one.message = message_of(result, context);
  one.locations.push_back(location_of(one.rule, context.places, context.name));
  if (one.level != SarifResult::Level::none) {
    one.related = related_to(one.rule, context, one.locations.front());
  }
  one.identity = {context.name, name_of(result.verdict)};
  return one;
}

/// What the model has not got, as notes: whoever reads the results has to know.
void add_unmodelled(report::SarifLog& log, const CheckContext& context) {
  if (context.scenario.dds.unmodelled.empty()) return;
  log.rules.push_back({"stormproof.unmodelled", report::unmodelled_heading,
                       "No result depends on a setting that the model has not got."});
  for (const auto& [setting, effect] : context.scenario.dds.unmodelled) {
    SarifResult one;
    one.rule = log.rules.back().id;
    one.level = SarifResult::Level::note;
    one.message = setting + ": " + effect;
    const auto place = context.places.find("dds.unmodelled." + setting);
    if (place != context.places.end()) one.locations.emplace_back(place->second);
    one.identity = {context.name, setting};
    log.results.push_back(std::move(one));
  }
}

}  // namespace

nlohmann::ordered_json to_sarif(const CheckReport& report, const CheckContext& context) {
  report::SarifLog log;
  log.command = context.command;
  log.exit_code = context.exit_code;
  log.complete = !report.interrupted;
  for (const PropertyResult& result : report.results) {
    std::string more{result.property->assumptions};
    if (!more.empty()) more = " Claimed under: " + more + ".";
    const std::string statement =
        statement_of(*result.property, context.scenario.dds.implementation);
    log.rules.push_back({std::string{result.property->id}, statement, statement + more});
    log.results.push_back(result_of(result, context));
  }
  add_unmodelled(log, context);
  return to_json(log);
}

}  // namespace stormproof::checker
