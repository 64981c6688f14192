// The JSON form of a fuzz report. Times are integers in ns, sizes in bytes or packets; what does
// not exist is null.
#include "checker/experiments/fuzz/fuzz_report.hpp"
#include "checker/experiments/statistics/quantiles_json.hpp"

namespace stormproof::fuzz {

using Json = nlohmann::ordered_json;

template <class V>
void describe(V& v, const JudgedRun& run) {
  v("t_disc_ns", run.discovery_time);
  v("messages", run.messages);
  v("amplification", run.amplification);
  v("backlog", run.backlog);
  v("packets", run.packets);
  v("lost", run.lost);
  v("events", run.events);
}

template <class V>
void describe(V& v, const Breach& breach) {
  v("event", breach.event);
  v("time_ns", breach.time);
  v("reason", breach.reason);
}

namespace {

Json shrunk_json(const Shrunk& shrunk, const Judgment& judgment, const FuzzContext& context) {
  const auto stem = context.stems.find(judgment.id);
  const auto file = [&](const char* extension) {
    return stem == context.stems.end() ? std::string{} : stem->second + extension;
  };
  report::JsonObject v;
  v("participants", shrunk.counterexample.scenario.deployment.size());
  v("event", shrunk.counterexample.event);
  v("time_ns", shrunk.counterexample.time);
  v("reason", shrunk.counterexample.reason);
  v("differences", differences(shrunk.counterexample.scenario, context.scenario));
  v("tried", shrunk.tried);
  v("accepted", shrunk.accepted);
  v("finished", shrunk.finished);
  v.or_null("scenario_file", file(".yaml"));
  const auto trace = context.traces.find(judgment.id);
  v.or_null("counterexample_file", trace == context.traces.end() ? std::string{} : trace->second);
  return std::move(v).take();
}

Json judgment_json(const FuzzReport& report, const Judgment& judgment, const FuzzContext& context) {
  const bool known = judgment.runs > 0;
  Json violating = Json::array();
  for (const JudgedRun& run : report.runs) {
    const Breach* breach = run.breach(judgment.id);
    if (breach == nullptr) continue;
    report::JsonObject one;
    one("run", run.number);
    describe(one, *breach);
    violating.push_back(std::move(one).take());
  }
  report::JsonObject v;
  v("id", judgment.id);
  v("statement", judgment.statement);
  v("verdict", props::name_of(judgment.verdict));
  v("unperturbed", judgment.in_base);
  v("sampled", judgment.sampled);
  v("runs", judgment.runs);
  v("violations", judgment.broken);
  v("rate", known ? Json(static_cast<double>(judgment.broken) / static_cast<double>(judgment.runs))
                  : Json());
  v("rate_interval", known ? Json::array({judgment.rate.low, judgment.rate.high}) : Json());
  v("violating_runs", violating);
  v.or_null("first_command",
            judgment.broken > 0 ? context.single(report, judgment.first_broken) : std::string{});
  v("shrunk", judgment.shrunk ? shrunk_json(*judgment.shrunk, judgment, context) : Json());
  return std::move(v).take();
}

Json quantiles_json(const FuzzReport& report) {
  report::JsonObject v;
  v("t_disc_ns", report.completion_ns);
  v("messages", report.messages);
  v("amplification", report.amplification);
  v("backlog", report.backlog);
  return std::move(v).take();
}

}  // namespace

Json to_json(const FuzzReport& report, const FuzzContext& context) {
  Json ranges;
  for (const RangeText& range : describe(report.ranges, context.scenario)) {
    ranges[range.name] = range.text;
  }
  Json results = Json::array();
  for (const Judgment& judgment : report.judgments) {
    results.push_back(judgment_json(report, judgment, context));
  }
  Json samples = Json::array();
  for (const JudgedRun& run : report.runs) {
    report::JsonObject one;
    one("run", run.number);
    describe(one, run);
    samples.push_back(std::move(one).take());
  }
  report::JsonObject v;
  v("scenario", context.name);
  v("seed", report.seed);
  v("first", report.first);
  v("wanted", report.wanted);
  v("runs", report.runs.size());
  v("incomplete", report.incomplete);
  v("rejected_draws", report.rejected);
  v("usual_ranges", report.ranges.usual);
  v("ranges", ranges);
  v.unless_empty("unmodelled", context.scenario.dds.unmodelled);
  v("confidence", statistics::confidence_level);
  v("unperturbed", report.base_known ? report::json_of(report.base) : Json());
  v("results", results);
  v("quantiles", quantiles_json(report));
  v("samples", samples);
  return std::move(v).take();
}

}  // namespace stormproof::fuzz
