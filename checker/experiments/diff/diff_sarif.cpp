// A comparison as SARIF. Its results are about the candidate: each points at the changed knobs in
// the candidate's file, the first that matters in front.
#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "checker/experiments/diff/diff_report.hpp"
#include "checker/experiments/diff/judging.hpp"
#include "checker/experiments/diff/summary.hpp"
#include "checker/experiments/diff/words.hpp"
#include "checker/presentation/document/sarif.hpp"
#include "checker/presentation/text/assumptions.hpp"

namespace stormproof::diff {

namespace {

using report::SarifLocation;
using report::SarifResult;

constexpr const char* verdict_rule = "diff.verdict";
constexpr const char* cost_rule = "diff.cost";
constexpr const char* limit_rule = "diff.limit";
constexpr const char* margin_rule = "diff.margin";
constexpr const char* knob_rule = "diff.knob";
constexpr const char* unmodelled_rule = "diff.unmodelled";

std::vector<report::SarifRule> sarif_rules() {
  return {{verdict_rule, "A property that holds with the base does not with the candidate.", ""},
          {cost_rule, "Discovery costs more with the candidate than the policy tolerates.", ""},
          {limit_rule, "The candidate exceeds a limit that the base keeps.", ""},
          {margin_rule, "The storm-free margin is smaller with the candidate.", ""},
          {knob_rule, "A knob has another value.", ""},
          {unmodelled_rule, report::unmodelled_heading,
           "No result depends on a setting that the model has not got."}};
}

SarifResult::Level level_of(Judgment judgment) {
  switch (judgment) {
    case Judgment::regression:
      return SarifResult::Level::error;
    case Judgment::unclear:
      return SarifResult::Level::warning;
    case Judgment::worse:
      return SarifResult::Level::note;
    case Judgment::better:
    case Judgment::same:
      return SarifResult::Level::none;
  }
  return SarifResult::Level::warning;
}

/// The changed knobs in files, those that matter first.
std::vector<SarifLocation> places(const DiffReport& report) {
  std::vector<SarifLocation> locations;
  for (const bool matters : {true, false}) {
    for (const KnobChange& change : report.profiles.changes) {
      if (change.matters != matters) continue;
      SarifLocation location{change.after_place,
                             fmt::format("{}: {} → {}", change.key, change.before, change.after)};
      if (!location.file.empty()) locations.push_back(std::move(location));
    }
  }
  return locations;
}

/// The file of the candidate: that of its values, or the reference as the user gave it.
std::string file_of(const model::config::TracedProfile& profile) {
  for (const auto& [key, place] : profile.places) {
    if (place.source != nullptr && place.line > 0) return *place.source;
  }
  return profile.reference;
}

class Log {
 public:
  explicit Log(const DiffReport& report) : report_{report} {
    log_.rules = sarif_rules();
    log_.command = report.command;
    log_.complete = !report.interrupted;
    log_.exit_code = report.judgment == Judgment::regression                      ? 1
                     : report.judgment == Judgment::unclear || report.interrupted ? 3
                                                                                  : 0;
    places_ = places(report);
    if (places_.empty()) {
      SarifLocation whole;
      whole.file = file_of(report.candidate);
      whole.line = 1;
      places_.push_back(whole);
    }
  }

  void add(const char* rule, Judgment judgment, std::string message,
           std::vector<std::string> identity) {
    SarifResult result;
    result.rule = rule;
    result.level = level_of(judgment);
    result.message = std::move(message);
    result.locations = {places_.front()};
    result.related.assign(places_.begin() + 1, places_.end());
    result.identity = std::move(identity);
    result.identity.push_back(report_.base.reference);
    log_.results.push_back(std::move(result));
  }

  /// Each knob at its own place, so that a review shows it beside the line.
  void add_knobs() {
    for (const KnobChange& change : report_.profiles.changes) {
      SarifResult result;
      result.rule = change.key.starts_with("unmodelled.") ? unmodelled_rule : knob_rule;
      result.level = SarifResult::Level::note;
      result.message = fmt::format("{}: {} with the base, {} with the candidate.", change.key,
                                   change.before, change.after);
      if (!change.why.empty()) result.message += " " + change.why;
      result.locations.emplace_back(change.after_place);
      if (result.locations.front().file.empty()) result.locations = {places_.front()};
      result.identity = {change.key, report_.base.reference};
      log_.results.push_back(std::move(result));
    }
  }

  [[nodiscard]] const report::SarifLog& log() const { return log_; }

 private:
  const DiffReport& report_;
  report::SarifLog log_;
  std::vector<SarifLocation> places_;
};

void add_costs(const DiffReport& report, Log& log) {
  for (const Configuration& one : report.costs.configurations) {
    for (const MeasuredChange& change : one.measures) {
      if (!is_judged(report.policy, change.measure)) continue;
      if (level_of(change.judgment) == SarifResult::Level::none) continue;
      log.add(cost_rule, change.judgment,
              fmt::format("{} at {}: {} → {}, {}. {}", words_of(change.measure), one.name,
                          value_text(change.measure, change.before.median),
                          value_text(change.measure, change.after.median), change_text(change),
                          change.reason),
              {name_of(change.measure), one.name});
    }
    for (const LimitCrossing& crossing : one.crossings) {
      if (level_of(crossing.judgment) == SarifResult::Level::none) continue;
      log.add(limit_rule, crossing.judgment,
              fmt::format("Limit {} at {}: exceeded by {} of the runs with the base, by {} with "
                          "the candidate.",
                          crossing.text, one.name, share_text(crossing.before),
                          share_text(crossing.after)),
              {crossing.limit, one.name});
    }
  }
}

}  // namespace

nlohmann::ordered_json to_sarif(const DiffReport& report, const Files& files) {
  Log log{report};
  for (const VerdictChange& change : report.verdicts.properties) {
    if (level_of(change.judgment) == SarifResult::Level::none) continue;
    std::string message = fmt::format(
        "{} is {} with the base and {} with the candidate ({}): {}", change.property,
        name_of(change.before), name_of(change.after), report.verdicts.scenario, change.after_how);
    const auto file = files.find(change.property);
    if (file != files.end()) message += " Replay it: stormproof replay " + file->second;
    log.add(verdict_rule, change.judgment, message, {change.property});
  }
  add_costs(report, log);
  if (level_of(report.margin.judgment) != SarifResult::Level::none) {
    log.add(margin_rule, report.margin.judgment, "Storm-free margin: " + report.margin.reason, {});
  }
  log.add_knobs();
  return to_json(log.log());
}

}  // namespace stormproof::diff
