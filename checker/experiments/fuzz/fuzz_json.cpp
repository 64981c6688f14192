// The JSON form of a fuzz report. Times are integers in ns, sizes in bytes or packets; what does
// not exist is null.
#include <nlohmann/json.hpp>

#include "checker/experiments/fuzz/fuzz_report.hpp"
#include "checker/presentation/text/assumptions.hpp"

namespace stormproof::fuzz {

namespace {

using Json = nlohmann::ordered_json;

Json time_json(const std::optional<model::Nanoseconds>& time) {
  return time ? Json(time->count()) : Json(nullptr);
}

Json run_json(const JudgedRun& run) {
  return {{"t_disc_ns", time_json(run.discovery_time)},
          {"messages", run.messages},
          {"amplification", run.amplification},
          {"backlog", run.backlog},
          {"packets", run.packets},
          {"lost", run.lost},
          {"events", run.events}};
}

Json breach_json(const Breach& breach) {
  return {{"event", breach.event}, {"t", breach.time.count()}, {"reason", breach.reason}};
}

Json quantiles_json(const sampling::Quantiles& quantiles) {
  const auto value = [](const std::optional<double>& v) { return v ? Json(*v) : Json(nullptr); };
  return {{"min", value(quantiles.min)},
          {"p10", value(quantiles.p10)},
          {"median", value(quantiles.median)},
          {"p90", value(quantiles.p90)},
          {"max", value(quantiles.max)}};
}

Json shrunk_json(const Shrunk& shrunk, const Judgment& judgment, const FuzzContext& context) {
  Json json = {{"participants", shrunk.counterexample.scenario.deployment.size()},
               {"event", shrunk.counterexample.event},
               {"t", shrunk.counterexample.time.count()},
               {"reason", shrunk.counterexample.reason},
               {"differences", differences(shrunk.counterexample.scenario, context.scenario)},
               {"tried", shrunk.tried},
               {"accepted", shrunk.accepted},
               {"finished", shrunk.finished}};
  const auto stem = context.stems.find(judgment.id);
  const bool written = stem != context.stems.end();
  json["scenario_file"] = written ? Json(stem->second + ".yaml") : Json(nullptr);
  json["counterexample_file"] = written ? Json(stem->second + ".jsonl") : Json(nullptr);
  return json;
}

Json judgment_json(const FuzzReport& report, const Judgment& judgment, const FuzzContext& context) {
  Json json = {{"id", judgment.id},
               {"statement", judgment.statement},
               {"verdict", props::name_of(judgment.verdict)},
               {"unperturbed", judgment.in_base ? breach_json(*judgment.in_base) : Json(nullptr)},
               {"sampled", judgment.sampled},
               {"runs", judgment.runs},
               {"violations", judgment.broken}};
  const bool known = judgment.runs > 0;
  json["rate"] =
      known ? Json(static_cast<double>(judgment.broken) / static_cast<double>(judgment.runs))
            : Json(nullptr);
  json["rate_interval"] =
      known ? Json::array({judgment.rate.low, judgment.rate.high}) : Json(nullptr);
  Json violating = Json::array();
  for (const JudgedRun& run : report.runs) {
    const Breach* breach = run.breach(judgment.id);
    if (breach == nullptr) continue;
    Json one = {{"run", run.number}};
    one.update(breach_json(*breach));
    violating.push_back(std::move(one));
  }
  json["violating_runs"] = std::move(violating);
  json["first_command"] =
      judgment.broken > 0 ? Json(context.single(report, judgment.first_broken)) : Json(nullptr);
  json["shrunk"] =
      judgment.shrunk ? shrunk_json(*judgment.shrunk, judgment, context) : Json(nullptr);
  return json;
}

}  // namespace

Json to_json(const FuzzReport& report, const FuzzContext& context) {
  Json json;
  json["scenario"] = context.name;
  json["seed"] = report.seed;
  json["first"] = report.first;
  json["wanted"] = report.wanted;
  json["runs"] = report.runs.size();
  json["incomplete"] = report.incomplete;
  json["rejected_draws"] = report.rejected;
  json["usual_ranges"] = report.ranges.usual;
  Json ranges;
  for (const RangeText& range : describe(report.ranges, context.scenario)) {
    ranges[range.name] = range.text;
  }
  json["ranges"] = std::move(ranges);
  report::add_unmodelled(json, context.scenario.dds);
  json["confidence"] = confidence_level;
  json["unperturbed"] = report.base_known ? run_json(report.base) : Json(nullptr);
  Json results = Json::array();
  for (const Judgment& judgment : report.judgments) {
    results.push_back(judgment_json(report, judgment, context));
  }
  json["results"] = std::move(results);
  json["quantiles"] = {{"t_disc_ns", quantiles_json(report.completion_ns)},
                       {"messages", quantiles_json(report.messages)},
                       {"amplification", quantiles_json(report.amplification)},
                       {"backlog", quantiles_json(report.backlog)}};
  Json samples = Json::array();
  for (const JudgedRun& run : report.runs) {
    Json one = {{"run", run.number}};
    one.update(run_json(run));
    samples.push_back(std::move(one));
  }
  json["samples"] = std::move(samples);
  return json;
}

}  // namespace stormproof::fuzz
