// A comparison as findings. Those beside the code are about the candidate: each points at the
// changed knobs in the candidate's file, the first that matters in front. Test cases are one for
// each property, configuration and the margin: a regression fails, what is unclear is an error.
#include <fmt/core.h>

#include "checker/experiments/diff/diff_parts.hpp"
#include "checker/experiments/diff/judging.hpp"
#include "checker/experiments/diff/summary.hpp"
#include "checker/experiments/diff/words.hpp"
#include "checker/presentation/text/command_line.hpp"

namespace stormproof::diff {

namespace {

using report::Finding;
using report::Location;
using Outcome = report::Finding::Outcome;
using Shown = report::Finding::Shown;

Outcome outcome_of(Judgment judgment) {
  switch (judgment) {
    case Judgment::regression:
      return Outcome::failed;
    case Judgment::unclear:
      return Outcome::unknown;
    case Judgment::worse:
      return Outcome::note;
    case Judgment::better:
    case Judgment::same:
      break;
  }
  return Outcome::passed;
}

/// The changed knobs in files, those that matter first; else the candidate's file as a whole.
std::vector<Location> places(const DiffReport& report) {
  std::vector<Location> locations;
  for (const bool matters : {true, false}) {
    for (const KnobChange& change : report.profiles.changes) {
      if (change.matters != matters) continue;
      Location location{change.after_place,
                        fmt::format("{}: {} → {}", change.key, change.before, change.after)};
      if (!location.file.empty()) locations.push_back(std::move(location));
    }
  }
  if (!locations.empty()) return locations;
  Location whole;
  whole.file = report.candidate.reference;
  for (const auto& [key, place] : report.candidate.places) {
    if (place.source == nullptr || place.line == 0) continue;
    whole.file = *place.source;
    break;
  }
  return {whole};
}

class Findings {
 public:
  Findings(report::Document& document, const DiffReport& report, const Files& files)
      : findings_{document.findings}, report_{report}, files_{files}, places_{places(report)} {}

  void add() {
    Finding& whole = test("profiles", "judgment", report_.judgment);
    whole.message = fmt::format("{}: {}", headline(report_), headline_sentence(report_));
    whole.details = whole.message;
    for (const std::string& reason : report_.reasons) whole.details += "\n" + reason;
    for (const VerdictChange& change : report_.verdicts.properties) add(change);
    for (const Configuration& one : report_.costs.configurations) add(one);
    test("margin", "storm-free margin", report_.margin.judgment).message = report_.margin.reason;
    beside("diff.margin", "The storm-free margin is smaller with the candidate.",
           report_.margin.judgment, "Storm-free margin: " + report_.margin.reason, {});
    for (const KnobChange& change : report_.profiles.changes) add(change);
  }

 private:
  /// A test case. What is only worse passes.
  Finding& test(const char* group, const std::string& name, Judgment judgment) {
    Finding& finding = findings_.emplace_back();
    finding.id = std::string{"diff."} + group;
    finding.group = std::string{"stormproof.diff."} + group;
    finding.name = name;
    finding.outcome = judgment == Judgment::worse ? Outcome::passed : outcome_of(judgment);
    finding.word = name_of(judgment);
    finding.shown = Shown::tests;
    return finding;
  }

  /// A remark beside the changed knobs, if there is anything to remark.
  Finding* beside(const char* rule, const char* statement, Judgment judgment, std::string message,
                  std::vector<std::string> identity) {
    if (outcome_of(judgment) == Outcome::passed) return nullptr;
    Finding& finding = findings_.emplace_back();
    finding.id = rule;
    finding.statement = statement;
    finding.outcome = outcome_of(judgment);
    finding.message = std::move(message);
    finding.locations = {places_.front()};
    finding.related.assign(places_.begin() + 1, places_.end());
    finding.identity = std::move(identity);
    finding.identity.push_back(report_.base.reference);
    finding.shown = Shown::code;
    return &finding;
  }

  void add(const VerdictChange& change) {
    const auto file = files_.find(change.property);
    const std::string replay =
        file == files_.end() ? std::string{} : report::command_line({"replay", file->second});
    Finding& one = test("verdict", change.property, change.judgment);
    one.message =
        fmt::format("{} with the base, {} with the candidate, on {}", props::name_of(change.before),
                    props::name_of(change.after), report_.verdicts.scenario);
    one.details = fmt::format("{}\n{}\nbase: {}\ncandidate: {}\n", one.message, change.statement,
                              change.before_how, change.after_how);
    one.command = replay;
    Finding* remark = beside(
        "diff.verdict", "A property that holds with the base does not with the candidate.",
        change.judgment,
        fmt::format("{} is {} with the base and {} with the candidate ({}): {}", change.property,
                    props::name_of(change.before), props::name_of(change.after),
                    report_.verdicts.scenario, change.after_how),
        {change.property});
    if (remark != nullptr) remark->command = replay;
  }

  /// One test case with the worst judgment of the configuration and all reasons for it; a remark
  /// for each measure and limit.
  void add(const Configuration& one) {
    std::string failures;
    std::string doubts;
    std::string text = plural(one.samples, "run") + " of each side\n";
    const auto note = [&](Judgment judgment, const std::string& sentence) {
      std::string* list = judgment == Judgment::regression ? &failures
                          : judgment == Judgment::unclear  ? &doubts
                                                           : nullptr;
      if (list != nullptr) *list += (list->empty() ? "" : "; ") + sentence;
    };
    for (const MeasuredChange& change : one.measures) {
      const std::string medians =
          fmt::format("{} → {}, {}", value_text(change.measure, change.before.median),
                      value_text(change.measure, change.after.median), change_text(change));
      note(change.judgment, fmt::format("{}: {}", words_of(change.measure), change.reason));
      text += fmt::format("{}: {}\n", words_of(change.measure), medians);
      if (!is_judged(report_.policy, change.measure)) continue;
      beside("diff.cost", "Discovery costs more with the candidate than the policy tolerates.",
             change.judgment,
             fmt::format("{} at {}: {}. {}", words_of(change.measure), one.name, medians,
                         change.reason),
             {name_of(change.measure), one.name});
    }
    for (const LimitCrossing& crossing : one.crossings) {
      const std::string exceeded =
          fmt::format("exceeded by {} of the runs before, by {} after", share_text(crossing.before),
                      share_text(crossing.after));
      note(crossing.judgment, fmt::format("limit {}: {}", crossing.text, exceeded));
      text += fmt::format("limit {}: {}\n", crossing.text, exceeded);
      beside("diff.limit", "The candidate exceeds a limit that the base keeps.", crossing.judgment,
             fmt::format("Limit {} at {}: {}.", crossing.text, one.name, exceeded),
             {crossing.limit, one.name});
    }
    Finding& finding = test("cost", one.name,
                            !failures.empty() ? Judgment::regression
                            : !doubts.empty() ? Judgment::unclear
                                              : Judgment::same);
    finding.message = failures.empty() ? doubts : failures;
    finding.details = text;
  }

  /// At its own place, so that a review shows it beside the line.
  void add(const KnobChange& change) {
    const bool unmodelled = change.key.starts_with("unmodelled.");
    Finding* finding =
        beside(unmodelled ? "diff.unmodelled" : "diff.knob",
               unmodelled ? "A setting that the model has not got has another value."
                          : "A knob has another value.",
               Judgment::worse,
               fmt::format("{}: {} with the base, {} with the candidate.{}{}", change.key,
                           change.before, change.after, change.why.empty() ? "" : " ", change.why),
               {change.key});
    finding->related.clear();
    if (Location own{change.after_place}; !own.file.empty()) finding->locations = {own};
  }

  std::vector<Finding>& findings_;
  const DiffReport& report_;
  const Files& files_;
  std::vector<Location> places_;
};

}  // namespace

void add_findings(report::Document& document, const DiffReport& report, const Files& files) {
  Findings{document, report, files}.add();
}

}  // namespace stormproof::diff
