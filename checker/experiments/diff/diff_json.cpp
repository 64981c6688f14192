// A comparison as JSON; specs/guide/output.md describes the keys. What does not exist is null, what
// is infinite is text ("infinity"), as JSON has no number for it.
#include <map>
#include <string>
#include <vector>

#include "checker/experiments/diff/costs_json.hpp"
#include "checker/experiments/diff/diff_report.hpp"
#include "checker/experiments/diff/summary.hpp"
#include "checker/presentation/json/schema.hpp"
#include "model/config/knobs/effective.hpp"

namespace stormproof::diff {

namespace {

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
  v.or_null("counterexample", file == shown.files.end() ? std::string_view{} : file->second);
}

struct ChangeInContext {
  const VerdictChange& change;
  const Files& files;
};

template <class V>
void describe(V& v, const ChangeInContext& shown) {
  const VerdictChange& change = shown.change;
  std::optional<WrittenCounterexample> violation;
  if (change.counterexample) {
    violation.emplace(WrittenCounterexample{*change.counterexample, change.property, shown.files});
  }
  v("id", change.property);
  v("before", change.before);
  v("after", change.after);
  v("verdict", change.judgment);
  v("statement", change.statement);
  v("before_how", change.before_how);
  v("after_how", change.after_how);
  v("violation", violation);
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
void describe(V& v, const RolloutStep& step) {
  v("host", step.host);
  v("configuration", step.configuration);
}

template <class V>
void describe(V& v, const Rollout& rollout) {
  v("name", rollout.fleet);
  v("kind_count", rollout.kinds);
  v("fleet_count", rollout.fleets);
  v("best", rollout.best);
  v("worst", rollout.worst);
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
  v("rolling", report.rollouts);
  v("margin", ran ? std::optional{report.margin} : std::nullopt);
  v("blame", report.blame);
  v("telling_apart", apart);
  v("not_asked", sentences_of(report.unasked));
}

}  // namespace

nlohmann::ordered_json to_json(const DiffReport& report, const Files& files) {
  return report::json_of(ReportWithFiles{report, files});
}

nlohmann::ordered_json json_schema(report::SchemaDefinitions& definitions) {
  return report::schema_form<ReportWithFiles>(definitions);
}

}  // namespace stormproof::diff
