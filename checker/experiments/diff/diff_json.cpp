// A comparison as JSON; specs/guide/output.md describes the keys. What does not exist is null, what
// is infinite is text ("infinity"), as JSON has no number for it.
#include <cmath>

#include "checker/experiments/diff/diff_report.hpp"
#include "checker/experiments/diff/summary.hpp"
#include "checker/experiments/statistics/quantiles_json.hpp"
#include "model/config/knobs/effective.hpp"

namespace stormproof::diff {

namespace {

using report::json_of;
using Json = nlohmann::ordered_json;

Json number(double value) {
  if (std::isinf(value)) return value > 0 ? "infinity" : "-infinity";
  return json_of(value);
}

Json number(const std::optional<double>& value) { return value ? number(*value) : Json(); }

Json place_json(const model::config::Place& place) {
  if (!place.source) return nullptr;
  return {{"source", *place.source}, {"line", place.line}, {"column", place.column}};
}

/// As the JSON of runs has it.
std::string key_of(Measure measure) {
  return measure == Measure::completion ? "t_disc_ns" : name_of(measure);
}

Json counterexample_json(const props::Counterexample& run) {
  return {{"event", run.event}, {"time_ns", run.time.count()}, {"reason", run.reason}};
}

Json file_json(const Files& files, const std::string& what) {
  const auto file = files.find(what);
  return file == files.end() ? Json() : Json(file->second);
}

Json profile_json(const model::config::TracedProfile& profile) {
  report::JsonObject v;
  v("name", profile.reference);
  v.or_null("preset", profile.preset);
  v("profile", model::config::effective_json(profile.value));
  return std::move(v).take();
}

Json verdicts_json(const VerdictComparison& verdicts, const Files& files) {
  if (!verdicts.done) return nullptr;
  Json properties = Json::array();
  for (const VerdictChange& change : verdicts.properties) {
    report::JsonObject v;
    v("property", change.property);
    v("before", props::name_of(change.before));
    v("after", props::name_of(change.after));
    v("judgment", change.judgment);
    v("statement", change.statement);
    v("before_how", change.before_how);
    v("after_how", change.after_how);
    Json counterexample;
    if (change.counterexample) {
      counterexample = counterexample_json(*change.counterexample);
      counterexample["file"] = file_json(files, change.property);
    }
    v("counterexample", counterexample);
    properties.push_back(std::move(v).take());
  }
  return {{"scenario", verdicts.scenario}, {"properties", properties}};
}

Json telling_apart_json(const TellingApart& apart, const Files& files) {
  Json json;
  json["found"] = apart.found;
  json["how"] = apart.how;
  json["tried"] = apart.tried;
  json["finished"] = apart.finished;
  if (!apart.found) return json;
  json["difference"] = apart.difference;
  json["event"] = apart.event;
  json["scenario"] = model::config::effective_json(apart.scenario);
  json["candidate"] = model::config::effective_json(apart.candidate);
  json["base_run"] = counterexample_json(apart.base_run);
  json["candidate_run"] = counterexample_json(apart.candidate_run);
  json["files"] = Json::object();
  for (const auto& [what, file] : files) {
    if (what.starts_with("telling-apart")) json["files"][what] = file;
  }
  return json;
}

}  // namespace

template <class V>
void describe(V& v, const KnobChange& change) {
  v("key", change.key);
  v("before", change.before);
  v("after", change.after);
  v("before_place", place_json(change.before_place));
  v("after_place", place_json(change.after_place));
  v("matters", change.modelled ? Json(change.matters) : Json());
  v("why", change.why);
}

template <class V>
void describe(V& v, const Comparison& profiles) {
  v("relation", profiles.relation);
  v.or_null("proof", profiles.proof);
  v("changes", profiles.changes);
}

static Json shift_json(const Shift& shift) {
  return {{"estimate", number(shift.estimate)},
          {"low", number(shift.low)},
          {"high", number(shift.high)},
          {"confidence", shift.confidence},
          {"exact", shift.exact}};
}

template <class V>
void describe(V& v, const MeasuredChange& change) {
  v("before", change.before);
  v("after", change.after);
  v("shift", change.shift ? shift_json(*change.shift) : Json());
  v("relative", !change.relative ? Json()
                                 : Json{{"estimate", number(change.relative)},
                                        {"low", number(change.relative_low)},
                                        {"high", number(change.relative_high)}});
  v("judgment", change.judgment);
  v("reason", change.reason);
}

template <class V>
void describe(V& v, const LimitCrossing& crossing) {
  v("limit", crossing.limit);
  v("text", crossing.text);
  v("before", crossing.before);
  v("after", crossing.after);
  v("judgment", crossing.judgment);
}

template <class V>
void describe(V& v, const Configuration& configuration) {
  Json values = Json::object();
  for (const auto& [key, value] : configuration.values) values[key] = value;
  Json measures;
  for (const MeasuredChange& change : configuration.measures) {
    measures[key_of(change.measure)] = json_of(change);
  }
  v("name", configuration.name);
  v("values", values);
  v("hosts", configuration.hosts);
  v("participants", configuration.participants);
  v("descriptors", configuration.descriptors);
  v("samples", configuration.samples);
  v("identical_runs", configuration.identical_runs);
  v("storm_before", configuration.storm_before);
  v("storm_after", configuration.storm_after);
  v("measures", measures);
  v("crossings", configuration.crossings);
}

template <class V>
void describe(V& v, const PooledChange& pooled) {
  v("measure", key_of(pooled.measure));
  v("configurations", pooled.configurations);
  v("pairs", pooled.pairs);
  v("estimate", number(pooled.estimate));
  v("low", number(pooled.low));
  v("high", number(pooled.high));
  v("confidence", pooled.confidence);
  v("judgment", pooled.judgment);
}

template <class V>
void describe(V& v, const CostComparison& costs) {
  v("grid", costs.grid);
  v("samples", costs.samples);
  v("seed", costs.seed);
  v("wanted", costs.wanted);
  v("confidence", costs.confidence);
  v("configurations", costs.configurations);
  v("pooled", costs.pooled);
}

template <class V>
void describe(V& v, const Margin& margin) {
  v("threshold_ns", margin.threshold);
  v("unlimited", margin.unlimited);
  v("formula", margin.formula);
  v("load", margin.load);
  v("load_configuration", margin.load_configuration);
}

template <class V>
void describe(V& v, const MarginComparison& margin) {
  v("before", margin.before);
  v("after", margin.after);
  v("judgment", margin.judgment);
  v("reason", margin.reason);
}

template <class V>
void describe(V& v, const Blame::Entry& entry) {
  v("reverted", entry.reverted);
  v("t_disc_ns", number(entry.completion_median));
  v("messages", number(entry.messages_median));
  v("cures", entry.cures);
}

template <class V>
void describe(V& v, const Blame& blame) {
  v("configuration", blame.configuration);
  v("entries", blame.entries);
}

Json to_json(const DiffReport& report, const Files& files) {
  const bool ran = report.costs.wanted > 0;
  report::JsonObject v;
  v("judgment", report.judgment);
  v("summary", std::string{headline(report)} + ": " + headline_sentence(report));
  v("reasons", report.reasons);
  v("policy", report.policy.name);
  v("seconds", report.seconds);
  v("base", profile_json(report.base));
  v("candidate", profile_json(report.candidate));
  v("knobs", report.profiles);
  v("verdicts", verdicts_json(report.verdicts, files));
  v("costs", ran ? json_of(report.costs) : Json());
  v("margin", ran ? json_of(report.margin) : Json());
  v("blame", report.blame);
  v("telling_apart", ran ? telling_apart_json(report.telling_apart, files) : Json());
  return std::move(v).take();
}

}  // namespace stormproof::diff
