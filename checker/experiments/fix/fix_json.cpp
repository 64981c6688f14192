// Everything the report knows, but the single runs.
#include "checker/experiments/fix/fix_report.hpp"
#include "checker/experiments/statistics/confidence.hpp"
#include "checker/experiments/statistics/quantiles_json.hpp"
#include "checker/presentation/json/schema.hpp"

namespace stormproof::fix {

namespace {

struct RunsOf {
  const launch::Cell& cell;
};

template <class V>
void describe(V& v, const RunsOf& shown) {
  const launch::Cell& cell = shown.cell;
  const auto outlook = trials::outlook_of(cell.runs);
  const auto storm = statistics::clopper_pearson(cell.storms, cell.runs.size());
  v.or_null("sentence", outlook ? outlook->headline() + ": " + outlook->sentence() : "");
  v("runs", cell.runs.size());
  v("storms", cell.storms);
  v("incomplete", cell.incomplete);
  v("storm_probability", std::pair{storm.low, storm.high});
  v("t_disc_ns", cell.completion);
  v("messages", cell.messages);
}

struct AttemptOf {
  const Attempt& attempt;
};

template <class V>
void describe(V& v, const AttemptOf& shown) {
  const Attempt& made = shown.attempt;
  v("kind", std::string_view{name_of(made.kind)});
  v("name", made.name);
  v("change", made.candidate.change);
  v.or_null("plan", made.plan ? std::string_view{name_of(made.plan->order)} : "");
  v("step_ns", made.plan ? std::optional{made.plan->step} : std::nullopt);
  v("trials", RunsOf{made.runs});
  v.or_null("not_run", made.not_run);
}

struct ReportOf {
  const Report& report;
  const Request& request;
  const Context& context;
};

template <class V>
void describe(V& v, const ReportOf& shown) {
  const Report& report = shown.report;
  std::vector<AttemptOf> attempts;
  for (const Attempt& one : report.attempts) attempts.push_back({one});
  std::vector<std::string> kept;
  for (const Kind kind : shown.request.keep) kept.emplace_back(name_of(kind));
  std::vector<std::string> untried;
  for (const Kind kind : report.untried) untried.emplace_back(name_of(kind));
  const launch::Cell* after = report.after();
  v("scenario", shown.request.scenario);
  v("verdict", std::string_view{name_of(report.answer)});
  v("kept", kept);
  v("wanted", shown.request.samples);
  v("seed", shown.request.seed);
  v("start_jitter_ns", shown.request.start_jitter);
  v("usual_hosts", report.usual_hosts);
  v("before", RunsOf{report.before});
  v("after", after != nullptr ? std::optional{RunsOf{*after}} : std::nullopt);
  v("attempts", attempts);
  v.or_null("recommended",
            report.chosen ? std::string_view{report.attempts[*report.chosen].name} : "");
  v("no_time_for", untried);
  v("written_files", shown.context.written);
  v("loading", shown.context.loading);
}

}  // namespace

nlohmann::ordered_json to_json(const Report& report, const Request& request,
                               const Context& context) {
  return report::json_of(ReportOf{report, request, context});
}

nlohmann::ordered_json json_schema(report::SchemaDefinitions& definitions) {
  return report::schema_form<ReportOf>(definitions);
}

}  // namespace stormproof::fix
