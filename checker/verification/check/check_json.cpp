// The JSON of a check.
#include "checker/presentation/json/describe.hpp"
#include "checker/verification/check/check_report.hpp"

namespace stormproof::props {

template <class V>
void describe(V& v, const Finding& finding) {
  v("engine", finding.engine);
  v("verdict", finding.kind);
  v("how", finding.how);
  v("assumptions", finding.assumptions);
  v("seconds", finding.seconds);
  v.or_null("solver", finding.solver);
  v("seed", finding.seed);
  v("details", finding.details);
}

}  // namespace stormproof::props

namespace stormproof::checker {

namespace {

struct ResultInContext {
  const PropertyResult& result;
  const CheckContext& context;
};

template <class V>
void describe(V& v, const ResultInContext& shown) {
  const PropertyResult& result = shown.result;
  const props::Finding& decisive = result.decisive();
  v("id", result.property->id);
  v("statement", statement_of(*result.property, shown.context.scenario.dds.implementation));
  v("verdict", result.verdict);
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

struct Summary {
  const CheckReport& report;
};

template <class V>
void describe(V& v, const Summary& summary) {
  using props::VerdictKind;
  for (const VerdictKind kind : {VerdictKind::proved, VerdictKind::bounded, VerdictKind::sampled,
                                 VerdictKind::violated, VerdictKind::inconclusive}) {
    v(name_of(kind), summary.report.count(kind));
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
  v("implementation", model::is_fastdds(dds) ? "fastdds" : "paper");
  v("seconds", shown.report.seconds);
  v("summary", Summary{shown.report});
  v.unless_empty("unmodelled", dds.unmodelled);
  std::vector<ResultInContext> verdicts;
  for (const PropertyResult& result : shown.report.results) {
    verdicts.push_back({result, shown.context});
  }
  v("verdicts", verdicts);
}

}  // namespace

nlohmann::ordered_json to_json(const CheckReport& report, const CheckContext& context) {
  return report::json_of(ReportInContext{report, context});
}

}  // namespace stormproof::checker
