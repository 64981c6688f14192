// The JSON of a check.
#include <nlohmann/json.hpp>

#include "checker/presentation/text/assumptions.hpp"
#include "checker/verification/check/check_report.hpp"

namespace stormproof::checker {

namespace {

using Json = nlohmann::ordered_json;
using props::VerdictKind;

Json finding_json(const props::Finding& finding) {
  Json json;
  json["engine"] = finding.engine;
  json["verdict"] = name_of(finding.kind);
  json["how"] = finding.how;
  json["assumptions"] = finding.assumptions;
  json["seconds"] = finding.seconds;
  json["solver"] = finding.solver.empty() ? Json() : Json(finding.solver);
  json["seed"] = finding.seed;
  json["details"] = finding.details;
  return json;
}

Json result_json(const PropertyResult& result, const CheckContext& context) {
  const props::Finding& decisive = result.decisive();
  Json json;
  json["id"] = result.property->id;
  json["statement"] = statement_of(*result.property, context.scenario.dds.implementation);
  json["verdict"] = name_of(result.verdict);
  json["engine"] = decisive.engine;
  json["how"] = decisive.how;
  json["assumptions"] = decisive.assumptions;
  double seconds = 0;
  for (const props::Finding& finding : result.findings) seconds += finding.seconds;
  json["seconds"] = seconds;
  json["solver"] = decisive.solver.empty() ? Json() : Json(decisive.solver);
  json["seed"] = decisive.seed;
  const auto file = context.counterexamples.find(result.property->id);
  json["counterexample"] = file == context.counterexamples.end() ? Json() : Json(file->second);
  const props::Counterexample* counterexample = result.counterexample();
  json["reason"] = counterexample == nullptr ? Json() : Json(counterexample->reason);
  json["findings"] = Json::array();
  for (const props::Finding& finding : result.findings) {
    json["findings"].push_back(finding_json(finding));
  }
  return json;
}

}  // namespace

Json to_json(const CheckReport& report, const CheckContext& context) {
  Json json;
  json["scenario"] = context.name;
  json["implementation"] = context.scenario.dds.implementation == model::ImplementationKind::fastdds
                               ? "fastdds"
                               : "paper";
  json["seconds"] = report.seconds;
  json["interrupted"] = report.interrupted;
  json["summary"] = Json::object();
  for (const VerdictKind kind : {VerdictKind::proved, VerdictKind::bounded, VerdictKind::sampled,
                                 VerdictKind::violated, VerdictKind::inconclusive}) {
    json["summary"][name_of(kind)] = report.count(kind);
  }
  report::add_unmodelled(json, context.scenario.dds);
  json["verdicts"] = Json::array();
  for (const PropertyResult& result : report.results) {
    json["verdicts"].push_back(result_json(result, context));
  }
  return json;
}

}  // namespace stormproof::checker
