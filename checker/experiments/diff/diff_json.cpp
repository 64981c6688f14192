// A comparison as JSON; specs/guide/output.md describes the keys. What does not exist is null, what
// is infinite is text ("infinity"), as JSON has no number for it.
#include <cmath>
#include <map>
#include <string>
#include <variant>
#include <vector>

#include "checker/experiments/diff/diff_report.hpp"
#include "checker/experiments/diff/summary.hpp"
#include "checker/experiments/statistics/quantiles_json.hpp"
#include "checker/presentation/json/schema.hpp"
#include "model/config/knobs/effective.hpp"

namespace stormproof::diff {

namespace {

/// A number, or which infinity.
using Extended = std::variant<double, std::string>;

Extended number(double value) {
  if (std::isinf(value)) return value > 0 ? "infinity" : "-infinity";
  return value;
}

std::optional<Extended> number(const std::optional<double>& value) {
  return value ? std::optional{number(*value)} : std::nullopt;
}

/// As the JSON of runs has it.
std::string key_of(Measure measure) {
  if (measure == Measure::completion) return "t_disc_ns";
  return measure == Measure::backlog ? "peak_packets" : name_of(measure);
}

/// Where a value stands.
struct KnownPlace {
  const model::config::Place& place;
};

template <class V>
void describe(V& v, const KnownPlace& known) {
  v("file", known.place.source ? std::string_view{*known.place.source} : "");
  v("line", known.place.line);
  v("column", known.place.column);
}

std::optional<KnownPlace> known(const model::config::Place& place) {
  std::optional<KnownPlace> answer;
  if (place.source) answer.emplace(KnownPlace{place});
  return answer;
}

struct GivenProfile {
  const model::config::TracedProfile& profile;
};

template <class V>
void describe(V& v, const GivenProfile& side) {
  v("profile_name", side.profile.reference);
  v.or_null("preset", side.profile.preset);
  v.as_in("dds", "../dds.schema.json", model::config::effective_json(side.profile.value));
}

struct RunToEvent {
  const props::Counterexample& run;
};

template <class V>
void describe(V& v, const RunToEvent& shown) {
  v("event", shown.run.event);
  v("time_ns", shown.run.time);
  v("reason", shown.run.reason);
}

struct WrittenCounterexample {
  const props::Counterexample& run;
  const std::string& property;
  const Files& files;
};

template <class V>
void describe(V& v, const WrittenCounterexample& shown) {
  const auto file = shown.files.find(shown.property);
  describe(v, RunToEvent{shown.run});
  v.or_null("file", file == shown.files.end() ? std::string_view{} : file->second);
}

struct ChangeInContext {
  const VerdictChange& change;
  const Files& files;
};

template <class V>
void describe(V& v, const ChangeInContext& shown) {
  const VerdictChange& change = shown.change;
  std::optional<WrittenCounterexample> counterexample;
  if (change.counterexample) {
    counterexample.emplace(
        WrittenCounterexample{*change.counterexample, change.property, shown.files});
  }
  v("id", change.property);
  v("before", change.before);
  v("after", change.after);
  v("verdict", change.judgment);
  v("statement", change.statement);
  v("before_how", change.before_how);
  v("after_how", change.after_how);
  v("counterexample", counterexample);
}

struct ChecksInContext {
  const VerdictComparison& verdicts;
  const Files& files;
};

template <class V>
void describe(V& v, const ChecksInContext& shown) {
  std::vector<ChangeInContext> changes;
  for (const VerdictChange& change : shown.verdicts.properties) {
    changes.push_back({change, shown.files});
  }
  v("scenario", shown.verdicts.scenario);
  v("verdicts", changes);
}

struct ApartInContext {
  const TellingApart& apart;
  const Files& files;
};

template <class V>
void describe(V& v, const ApartInContext& shown) {
  const TellingApart& apart = shown.apart;
  std::map<std::string, std::string> files;
  for (const auto& [what, file] : shown.files) {
    if (what.starts_with("telling-apart")) files.emplace(what, file);
  }
  v("found", apart.found);
  v("how", apart.how);
  v("tried", apart.tried);
  v("finished", apart.finished);
  v.unless_empty("sentence", apart.difference);
  v.unless_empty("event", apart.found ? std::optional{apart.event} : std::nullopt);
  std::optional<nlohmann::ordered_json> scenario, candidate;
  std::optional<RunToEvent> base_run, candidate_run;
  if (apart.found) {
    scenario = model::config::effective_json(apart.scenario);
    candidate = model::config::effective_json(apart.candidate);
    base_run.emplace(RunToEvent{apart.base_run});
    candidate_run.emplace(RunToEvent{apart.candidate_run});
  }
  v.unless_empty("profile", scenario);
  v.unless_empty("candidate_dds", candidate);
  v.unless_empty("base_run", base_run);
  v.unless_empty("candidate_run", candidate_run);
  v.unless_empty("written", files);
}

struct ShownShift {
  const Shift& shift;
};

template <class V>
void describe(V& v, const ShownShift& shown) {
  v("estimate", number(shown.shift.estimate));
  v("low", number(shown.shift.low));
  v("high", number(shown.shift.high));
  v("confidence", shown.shift.confidence);
  v("exact", shown.shift.exact);
}

struct Relative {
  const MeasuredChange& change;
};

template <class V>
void describe(V& v, const Relative& relative) {
  v("estimate", number(relative.change.relative));
  v("low", number(relative.change.relative_low));
  v("high", number(relative.change.relative_high));
}

struct MedianTotal {
  const Blame::Entry& entry;
};

template <class V>
void describe(V& v, const MedianTotal& median) {
  v("total", median.entry.messages_median);
}

}  // namespace

template <class V>
void describe(V& v, const KnobChange& change) {
  v("key", change.key);
  v("before", change.before);
  v("after", change.after);
  v("before_place", known(change.before_place));
  v("after_place", known(change.after_place));
  v("matters", change.modelled ? std::optional{change.matters} : std::nullopt);
  v("why", change.why);
}

template <class V>
void describe(V& v, const MeasuredChange& change) {
  std::optional<ShownShift> shift;
  if (change.shift) shift.emplace(ShownShift{*change.shift});
  std::optional<Relative> relative;
  if (change.relative) relative.emplace(Relative{change});
  v("before", change.before);
  v("after", change.after);
  v("shift", shift);
  v("relative", relative);
  v("verdict", change.judgment);
  v("reason", change.reason);
}

template <class V>
void describe(V& v, const LimitCrossing& crossing) {
  v("id", crossing.limit);
  v("text", crossing.text);
  v("before", crossing.before);
  v("after", crossing.after);
  v("verdict", crossing.judgment);
}

namespace {

struct MeasuresOf {
  const Configuration& configuration;
};

template <class V>
void describe(V& v, const MeasuresOf& all) {
  for (const MeasuredChange& change : all.configuration.measures) v(key_of(change.measure), change);
}

}  // namespace

template <class V>
void describe(V& v, const Configuration& configuration) {
  nlohmann::ordered_map<std::string, std::string> values;
  for (const auto& [key, value] : configuration.values) values[key] = value;
  v("name", configuration.name);
  v("swept", values);
  v("hosts", configuration.hosts);
  v("participant_count", configuration.participants);
  v("descriptor_count", configuration.descriptors);
  v("runs", configuration.samples);
  v("identical_runs", configuration.identical_runs);
  v("storm_before", configuration.storm_before);
  v("storm_after", configuration.storm_after);
  v("measures", MeasuresOf{configuration});
  v("crossings", configuration.crossings);
}

template <class V>
void describe(V& v, const PooledChange& pooled) {
  v("measure", key_of(pooled.measure));
  v("configuration_count", pooled.configurations);
  v("runs", pooled.pairs);
  v("estimate", number(pooled.estimate));
  v("low", number(pooled.low));
  v("high", number(pooled.high));
  v("confidence", pooled.confidence);
  v("verdict", pooled.judgment);
}

template <class V>
void describe(V& v, const CostComparison& costs) {
  v("grid", costs.grid);
  v("wanted", costs.samples);
  v("seed", costs.seed);
  v("wanted_configurations", costs.wanted);
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
  v("verdict", margin.judgment);
  v("reason", margin.reason);
}

template <class V>
void describe(V& v, const Blame::Entry& entry) {
  v("reverted", entry.reverted);
  v("t_disc_ns", entry.completion_median);
  v("counts", MedianTotal{entry});
  v("cures", entry.cures);
}

template <class V>
void describe(V& v, const Blame& blame) {
  v("configuration", blame.configuration);
  v("entries", blame.entries);
}

namespace {

struct ReportWithFiles {
  const DiffReport& report;
  const Files& files;
};

template <class V>
void describe(V& v, const ReportWithFiles& shown) {
  const DiffReport& report = shown.report;
  const bool ran = report.costs.wanted > 0;
  std::optional<ChecksInContext> checks;
  if (report.verdicts.done) checks.emplace(ChecksInContext{report.verdicts, shown.files});
  std::optional<ApartInContext> apart;
  if (ran) apart.emplace(ApartInContext{report.telling_apart, shown.files});
  v("verdict", report.judgment);
  v("sentence", std::string{headline(report)} + ": " + headline_sentence(report));
  v("reasons", report.reasons);
  v("policy", report.policy.name);
  v("seconds", report.seconds);
  v("base", GivenProfile{report.base});
  v("candidate", GivenProfile{report.candidate});
  v("relation", report.profiles.relation);
  v.or_null("proof", report.profiles.proof);
  v("changes", report.profiles.changes);
  v("check", checks);
  v("costs", ran ? std::optional{report.costs} : std::nullopt);
  v("margin", ran ? std::optional{report.margin} : std::nullopt);
  v("blame", report.blame);
  v("telling_apart", apart);
}

}  // namespace

/// Each measure is there, by its name.
static Configuration example_of(report::Type<Configuration>) {
  Configuration configuration;
  for (std::size_t k = 0; k < measure_count; ++k) {
    configuration.measures[k].measure = static_cast<Measure>(k);
  }
  return configuration;
}

nlohmann::ordered_json to_json(const DiffReport& report, const Files& files) {
  return report::json_of(ReportWithFiles{report, files});
}

nlohmann::ordered_json json_schema(report::SchemaDefinitions& definitions) {
  return report::schema_form<ReportWithFiles>(definitions);
}

}  // namespace stormproof::diff
