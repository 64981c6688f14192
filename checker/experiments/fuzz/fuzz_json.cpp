// The JSON form of a fuzz report. Times are integers in ns, sizes in bytes or packets; what does
// not exist is null.
#include "checker/engines/exact/health_json.hpp"
#include "checker/experiments/fuzz/fuzz_report.hpp"
#include "checker/experiments/statistics/quantiles_json.hpp"
#include "checker/experiments/trials/sample_runs.hpp"
#include "checker/presentation/json/schema.hpp"

namespace stormproof::fuzz {

namespace {

/// Of all classes together.
struct TotalCount {
  std::uint64_t total = 0;
};

template <class V>
void describe(V& v, const TotalCount& of) {
  v("total", of.total);
}

struct TotalRatio {
  double total = 0;
};

template <class V>
void describe(V& v, const TotalRatio& of) {
  v("total", of.total);
}

struct TotalQuantiles {
  const statistics::Quantiles& total;
};

template <class V>
void describe(V& v, const TotalQuantiles& of) {
  v("total", of.total);
}

}  // namespace

template <class V>
void describe(V& v, const JudgedRun& run) {
  v("t_disc_ns", run.discovery_time);
  v("counts", TotalCount{run.messages});
  v("amplification", TotalRatio{run.amplification});
  v("peak_packets", run.backlog);
  v("packets", run.packets);
  v("lost", run.lost);
  v("events", run.events);
  v("health", run.health.health);
  v("since_last_start_ns", run.health.took);
}

template <class V>
void describe(V& v, const Breach& breach) {
  v("event", breach.event);
  v("time_ns", breach.time);
  v("reason", breach.reason);
}

namespace {

struct NumberedRun {
  const JudgedRun& run;
};

template <class V>
void describe(V& v, const NumberedRun& numbered) {
  v("run", numbered.run.number);
  describe(v, numbered.run);
}

struct BreachOfRun {
  std::uint64_t run = 0;
  const Breach& breach;
};

template <class V>
void describe(V& v, const BreachOfRun& one) {
  v("run", one.run);
  describe(v, one.breach);
}

struct ShrunkInContext {
  const Shrunk& shrunk;
  const Judgment& judgment;
  const FuzzContext& context;
};

template <class V>
void describe(V& v, const ShrunkInContext& shown) {
  const props::Counterexample& counterexample = shown.shrunk.counterexample;
  const auto stem = shown.context.stems.find(shown.judgment.id);
  v("participant_count", counterexample.scenario.deployment.size());
  v("event", counterexample.event);
  v("time_ns", counterexample.time);
  v("reason", counterexample.reason);
  v("differences", differences(counterexample.scenario, shown.context.scenario));
  v("tried", shown.shrunk.tried);
  v("accepted", shown.shrunk.accepted);
  v("finished", shown.shrunk.finished);
  v.or_null("scenario_file",
            stem == shown.context.stems.end() ? std::string{} : stem->second + ".yaml");
  const auto trace = shown.context.traces.find(shown.judgment.id);
  v.or_null("counterexample", trace == shown.context.traces.end() ? std::string{} : trace->second);
}

struct Rate {
  const Judgment& judgment;
};

template <class V>
void describe(V& v, const Rate& rate) {
  const Judgment& judgment = rate.judgment;
  v("estimate", static_cast<double>(judgment.broken) / static_cast<double>(judgment.runs));
  v("low", judgment.rate.low);
  v("high", judgment.rate.high);
  v("confidence", statistics::confidence_level);
}

struct JudgmentInContext {
  const Judgment& judgment;
  const FuzzReport& report;
  const FuzzContext& context;
};

template <class V>
void describe(V& v, const JudgmentInContext& shown) {
  const Judgment& judgment = shown.judgment;
  std::vector<BreachOfRun> violating;
  for (const JudgedRun& run : shown.report.runs) {
    const Breach* const breach = run.breach(judgment.id);
    if (breach != nullptr) violating.push_back({run.number, *breach});
  }
  std::optional<ShrunkInContext> shrunk;
  if (judgment.shrunk) shrunk.emplace(ShrunkInContext{*judgment.shrunk, judgment, shown.context});
  std::optional<Rate> rate;
  if (judgment.runs > 0) rate.emplace(Rate{judgment});
  v("id", judgment.id);
  v("statement", judgment.statement);
  v("verdict", judgment.verdict);
  v("unperturbed", judgment.in_base);
  v("sampled", judgment.sampled);
  v("runs", judgment.runs);
  v("violations", judgment.broken);
  v("rate", rate);
  v("violating_runs", violating);
  v.or_null("first_command", judgment.broken > 0
                                 ? shown.context.single(shown.report, judgment.first_broken)
                                 : std::string{});
  v("shrunk", shrunk);
}

struct Summary {
  const FuzzReport& report;
};

template <class V>
void describe(V& v, const Summary& summary) {
  const FuzzReport& report = summary.report;
  v("runs", report.runs.size());
  v("completed", report.runs.size() - report.incomplete);
  v("t_disc_ns", report.completion_ns);
  v("counts", TotalQuantiles{report.messages});
  v("amplification", TotalQuantiles{report.amplification});
  v("peak_packets", report.backlog);
}

struct ReportInContext {
  const FuzzReport& report;
  const FuzzContext& context;
};

template <class V>
void describe(V& v, const ReportInContext& shown) {
  const FuzzReport& report = shown.report;
  nlohmann::ordered_map<std::string, std::string> ranges;
  for (const RangeText& range : describe(report.ranges, shown.context.scenario)) {
    ranges[range.name] = range.text;
  }
  std::vector<JudgmentInContext> verdicts;
  for (const Judgment& judgment : report.judgments) {
    verdicts.push_back({judgment, report, shown.context});
  }
  std::vector<NumberedRun> samples;
  for (const JudgedRun& run : report.runs) samples.push_back({run});
  v("scenario", shown.context.name);
  v("seed", report.seed);
  v("first", report.first);
  v("wanted", report.wanted);
  v("runs", report.runs.size());
  v("rejected_draws", report.rejected);
  v("usual_ranges", report.ranges.usual);
  v("ranges", ranges);
  v.unless_empty("unmodelled", shown.context.scenario.dds.unmodelled);
  v("base", report.base_known ? std::optional{report.base} : std::nullopt);
  v("verdicts", verdicts);
  v("outlook", trials::outlook_of(report.runs));
  v("summary", Summary{report});
  v("samples", samples);
}

}  // namespace

nlohmann::ordered_json to_json(const FuzzReport& report, const FuzzContext& context) {
  return report::json_of(ReportInContext{report, context});
}

nlohmann::ordered_json json_schema(report::SchemaDefinitions& definitions) {
  return report::schema_form<ReportInContext>(definitions);
}

}  // namespace stormproof::fuzz
