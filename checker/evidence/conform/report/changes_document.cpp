// Two tables: by change, who rejects it; by capture, what it says of each change.
#include <algorithm>
#include <map>
#include <set>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "checker/evidence/conform/report/changes_report.hpp"
#include "checker/evidence/conform/report/names.hpp"
#include "checker/presentation/text/numbers.hpp"
#include "checker/presentation/text/plain_text.hpp"

namespace stormproof::conform {

namespace {

using report::Column;
using report::Tone;

/// In the order of their first appearance.
std::vector<std::string> names_of_changes(const ChangesReport& report) {
  std::vector<std::string> names;
  for (const Sensitivity& capture : report.captures) {
    for (const Tried& one : capture.tried) {
      if (std::ranges::find(names, one.change) == names.end()) names.push_back(one.change);
    }
  }
  return names;
}

std::vector<std::string> captures_with(const ChangesReport& report, const std::string& change,
                                       Notice notice) {
  std::vector<std::string> found;
  for (const Sensitivity& capture : report.captures) {
    for (const Tried& one : capture.tried) {
      if (one.change == change && one.notice == notice) found.push_back(capture.capture);
    }
  }
  return found;
}

std::string faults_of(const ChangesReport& report, const std::string& change) {
  std::set<std::string> faults;
  for (const Sensitivity& capture : report.captures) {
    for (const Tried& one : capture.tried) {
      if (one.change == change && one.fault) faults.emplace(name_of(*one.fault));
    }
  }
  return fmt::format("{}", fmt::join(faults, ", "));
}

report::Table by_change(const ChangesReport& report) {
  report::Table table{{{"change"},
                       {"rejected by", Column::Align::right},
                       {"acts in", Column::Align::right},
                       {"first fault", Column::Align::left, true}},
                      {},
                      "By change: how many captures reject it, of those in which the knob acts"};
  for (const std::string& change : names_of_changes(report)) {
    const std::size_t rejected = captures_with(report, change, Notice::rejected).size();
    const std::size_t acts = rejected + captures_with(report, change, Notice::explained).size() +
                             captures_with(report, change, Notice::inconclusive).size();
    table.rows.push_back({{change, report::grouped(rejected), report::grouped(acts),
                           rejected > 0 ? faults_of(report, change)
                           : acts == 0  ? "no event of these captures depends on it"
                                        : "these captures do not tell"},
                          rejected == 0});
  }
  for (const NoKnob& one : changes_without_knob()) {
    table.rows.push_back({{std::string{one.change}, "", "", std::string{one.why}}, true});
  }
  return table;
}

report::Table by_capture(const ChangesReport& report) {
  report::Table table{{{"capture"},
                       {"profile"},
                       {"verdict"},
                       {"rejects", Column::Align::left, true},
                       {"does not tell", Column::Align::left, true}},
                      {},
                      "By capture: which changes it rejects, and which it explains as well"};
  for (const Sensitivity& capture : report.captures) {
    std::map<Notice, std::vector<std::string>> changes;
    for (const Tried& one : capture.tried) changes[one.notice].push_back(one.change);
    auto untold = changes[Notice::explained];
    for (const std::string& one : changes[Notice::inconclusive]) {
      untold.push_back(one + " (inconclusive)");
    }
    table.rows.push_back({{report::code(capture.capture), report::code(capture.profile),
                           std::string{name_of(capture.verdict)},
                           fmt::format("{}", fmt::join(changes[Notice::rejected], ", ")),
                           fmt::format("{}", fmt::join(untold, ", "))}});
  }
  return table;
}

}  // namespace

bool all_conform(const ChangesReport& report) {
  return std::ranges::all_of(
      report.captures, [](const Sensitivity& one) { return one.verdict == Verdict::conforms; });
}

std::vector<std::string> unnoticed(const ChangesReport& report) {
  std::vector<std::string> names = names_of_changes(report);
  std::erase_if(names, [&](const std::string& change) {
    return !captures_with(report, change, Notice::rejected).empty();
  });
  return names;
}

report::Document document_of(const ChangesReport& report) {
  const std::vector<std::string> left = unnoticed(report);
  report::Document document;
  document.title = "stormproof conform --changes";
  document.tone = !all_conform(report) ? Tone::bad : left.empty() ? Tone::good : Tone::warn;
  document.answer = fmt::format(
      "{} of {} conform to their profiles; {} of {} changes of a knob are rejected by "
      "one of them or more",
      std::ranges::count(report.captures, Verdict::conforms, &Sensitivity::verdict),
      report::plural(report.captures.size(), "capture"),
      names_of_changes(report).size() - left.size(), names_of_changes(report).size());
  document.elaboration = fmt::format(
      "Each capture is held against its profile with one knob changed, within these bounds: {}. A "
      "capture that explains the changed profile, too, says nothing about that knob.",
      bounds_text(report.bounds));
  document.blocks.emplace_back(by_change(report));
  document.blocks.emplace_back(by_capture(report));
  document.complete = !report.interrupted;
  return document;
}

}  // namespace stormproof::conform
