// A comparison as JUnit XML: a regression is a failure, what is unclear an error.
#include <fmt/format.h>

#include "checker/experiments/diff/diff_report.hpp"
#include "checker/experiments/diff/summary.hpp"
#include "checker/experiments/diff/words.hpp"
#include "checker/presentation/document/junit.hpp"
#include "checker/presentation/text/assumptions.hpp"

namespace stormproof::diff {

namespace {

using report::JUnitCase;

JUnitCase case_of(const std::string& group, const std::string& name, Judgment judgment,
                  std::string message) {
  JUnitCase one;
  one.class_name = "stormproof.diff." + group;
  one.name = name;
  one.outcome = judgment == Judgment::regression ? JUnitCase::Outcome::failed
                : judgment == Judgment::unclear  ? JUnitCase::Outcome::error
                                                 : JUnitCase::Outcome::passed;
  one.type = name_of(judgment);
  one.message = std::move(message);
  one.text = one.message;
  return one;
}

void add_verdicts(const DiffReport& report, const Files& files, report::JUnitSuite& suite) {
  for (const VerdictChange& change : report.verdicts.properties) {
    JUnitCase one = case_of(
        "verdict", change.property, change.judgment,
        fmt::format("{} with the base, {} with the candidate, on {}", name_of(change.before),
                    name_of(change.after), report.verdicts.scenario));
    one.text = fmt::format("{}\n{}\nbase: {}\ncandidate: {}\n", one.message, change.statement,
                           change.before_how, change.after_how);
    const auto file = files.find(change.property);
    if (file != files.end()) one.text += "counterexample: " + file->second + "\n";
    suite.cases.push_back(std::move(one));
  }
}

/// The worst judgment of a configuration, with all reasons for it.
JUnitCase case_of(const Configuration& configuration) {
  std::string failures;
  std::string doubts;
  std::string text = plural(configuration.samples, "run") + " of each side\n";
  const auto note = [&](Judgment judgment, const std::string& sentence) {
    std::string* list = judgment == Judgment::regression ? &failures
                        : judgment == Judgment::unclear  ? &doubts
                                                         : nullptr;
    if (list != nullptr) *list += (list->empty() ? "" : "; ") + sentence;
  };
  for (const MeasuredChange& change : configuration.measures) {
    const char* words = words_of(change.measure);
    note(change.judgment, fmt::format("{}: {}", words, change.reason));
    text +=
        fmt::format("{}: {} → {}, {}\n", words, value_text(change.measure, change.before.median),
                    value_text(change.measure, change.after.median), change_text(change));
  }
  for (const LimitCrossing& crossing : configuration.crossings) {
    const std::string sentence =
        fmt::format("limit {}: exceeded by {} of the runs before, by {} after", crossing.text,
                    share_text(crossing.before), share_text(crossing.after));
    note(crossing.judgment, sentence);
    text += sentence + "\n";
  }
  const Judgment judgment = !failures.empty() ? Judgment::regression
                            : !doubts.empty() ? Judgment::unclear
                                              : Judgment::same;
  JUnitCase one =
      case_of("cost", configuration.name, judgment, failures.empty() ? doubts : failures);
  one.text = text;
  return one;
}

}  // namespace

std::string to_junit(const DiffReport& report, const Files& files) {
  report::JUnitSuite suite;
  suite.name =
      fmt::format("stormproof diff {} {}", report.base.reference, report.candidate.reference);
  suite.seconds = report.seconds;
  suite.cases.push_back(
      case_of("profiles", "judgment", report.judgment,
              fmt::format("{}: {}", headline(report), headline_sentence(report))));
  for (const std::string& reason : report.reasons) suite.cases.back().text += "\n" + reason;
  add_verdicts(report, files, suite);
  for (const Configuration& configuration : report.costs.configurations) {
    suite.cases.push_back(case_of(configuration));
  }
  suite.cases.push_back(
      case_of("margin", "storm-free margin", report.margin.judgment, report.margin.reason));
  suite.notes = report::unmodelled_text(report.base.profile, "base") +
                report::unmodelled_text(report.candidate.profile, "candidate");
  return to_xml(suite);
}

}  // namespace stormproof::diff
