// The JSON of a check.
#include "checker/engines/calculus/cannot_start.hpp"
#include "checker/engines/exact/health_json.hpp"
#include "checker/presentation/json/schema.hpp"
#include "checker/verification/check/check_report.hpp"
#include "model/implementations.hpp"
#include "props/applicability.hpp"

namespace stormproof::props {

template <class V>
void describe(V& v, const Finding& finding) {
  v("engine", finding.engine);
  v("verdict", finding.kind);
  v("how", finding.how);
  v("assumptions", finding.assumptions);
  v("longest_delay_ns", finding.longest_delay);
  v("seconds", finding.seconds);
  v.or_null("solver", finding.solver);
  v("seed", finding.seed);
  v("details", finding.details);
}

}  // namespace stormproof::props

namespace stormproof::calculus {

template <class V>
void describe(V& v, const Frontier& frontier) {
  v("grows", frontier.load);
  v("now", frontier.now);
  v("most", frontier.most);
  v("least_tried", frontier.least);
  v("most_tried", frontier.limit);
  v("longest_delay_ns", frontier.delay);
}

}  // namespace stormproof::calculus

namespace stormproof::checker {

template <class V>
void describe(V& v, const Failure& failure) {
  v("property", failure.property);
  v("reach", failure.reach);
}

struct Standings {
  const Gate& gate;
};

template <class V>
void describe(V& v, const Standings& standings) {
  for (const Standing one : checker::standings) {
    v(name_of(one), standings.gate.count(one));
  }
}

template <class V>
void describe(V& v, const Gate& gate) {
  v("passes", gate.exit_code == 0);
  v("require", gate.rules.require);
  v("strict", gate.rules.strict);
  v("standings", Standings{gate});
  v("storm", gate.outlook_id == storm_id ? gate.outlook : Standing::holds);
  v("failures", gate.failures);
  v("outdated", gate.outdated);
}

static PropertyResult example_of(report::Type<PropertyResult>) {
  PropertyResult result;
  result.property = &props::catalogue().front();
  result.findings.emplace_back();
  return result;
}

namespace {

/// What each of the three questions is answered.
struct VerdictByReach {
  const PropertyResult& result;
};

template <class V>
void describe(V& v, const VerdictByReach& by) {
  for (const props::Reach reach : props::reaches) {
    const props::Finding* const answer = answer_to(reach, by.result);
    v(name_of(reach), answer == nullptr ? std::nullopt : std::optional{answer->kind});
  }
}

struct ResultInContext {
  const PropertyResult& result;
  Standing standing{};
  const CheckContext& context;
};

template <class V>
void describe(V& v, const ResultInContext& shown) {
  const PropertyResult& result = shown.result;
  const props::Finding& decisive = result.decisive();
  v("id", result.property->id);
  v("statement", statement_of(*result.property, model::kind_of(shown.context.scenario.dds)));
  v("verdict", result.verdict);
  v("standing", shown.standing);
  v("reaches", VerdictByReach{result});
  v.or_null("weakness", applicability_of(*result.property, shown.context.scenario).weakness);
  v("engine", decisive.engine);
  v("how", decisive.how);
  v("assumptions", decisive.assumptions);
  double seconds = 0;
  for (const props::Finding& finding : result.findings) seconds += finding.seconds;
  v("seconds", seconds);
  v.or_null("solver", decisive.solver);
  v("seed", decisive.seed);
  const auto file = shown.context.counterexamples.find(result.property->id);
  v.or_null("counterexample", file == shown.context.counterexamples.end() ? "" : file->second);
  const props::Counterexample* counterexample = result.counterexample();
  v.or_null("reason", counterexample == nullptr ? "" : counterexample->reason);
  v("findings", result.findings);
}

struct Totals {
  const CheckReport& report;
};

template <class V>
void describe(V& v, const Totals& totals) {
  for (const props::VerdictKind kind : props::verdict_kinds) {
    v(name_of(kind), totals.report.count(kind));
  }
}

struct ReportInContext {
  const CheckReport& report;
  const CheckContext& context;
};

template <class V>
void describe(V& v, const ReportInContext& shown) {
  const model::DdsProfile& dds = shown.context.scenario.dds;
  v("scenario", shown.context.name);
  v("implementation", model::traits_of(dds).name);
  v("seconds", shown.report.seconds);
  v("totals", Totals{shown.report});
  v("gate", shown.context.gate);
  v("outlook", shown.report.outlook);
  v.unless_empty("unmodelled", dds.unmodelled);
  std::vector<ResultInContext> verdicts;
  for (const PropertyResult& result : shown.report.results) {
    verdicts.push_back({result, shown.context.gate.standings[verdicts.size()], shown.context});
  }
  v("verdicts", verdicts);
  const calculus::Frontiers frontiers = shown.report.frontiers.value_or(calculus::Frontiers{});
  v.unless_empty("frontiers", frontiers.of_loads);
  std::map<std::string, std::string> reasons;
  for (const auto& one : shown.report.not_applicable) {
    reasons.emplace(one.first, one.second);
  }
  if (!frontiers.why_not.empty()) reasons.emplace(calculus::cannot_start, frontiers.why_not);
  v.unless_empty("does_not_apply", reasons);
}

}  // namespace

nlohmann::ordered_json to_json(const CheckReport& report, const CheckContext& context) {
  return report::json_of(ReportInContext{report, context});
}

nlohmann::ordered_json check_schema(report::SchemaDefinitions& definitions) {
  return report::schema_form<ReportInContext>(definitions);
}

}  // namespace stormproof::checker
