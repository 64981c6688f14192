// A comparison as GitHub's Markdown: the judgment and its reasons, short tables, the rest folded.
#include <cmath>

#include <fmt/format.h>

#include "checker/experiments/diff/diff_report.hpp"
#include "checker/experiments/diff/summary.hpp"
#include "checker/experiments/diff/words.hpp"
#include "checker/presentation/document/markdown.hpp"
#include "checker/presentation/text/assumptions.hpp"
#include "checker/presentation/text/numbers.hpp"
#include "checker/verification/counterexample/chart.hpp"

namespace stormproof::diff {

namespace {

using report::md_code;
using report::md_table;
using report::md_text;
using Rows = std::vector<std::vector<std::string>>;

const char* sign_of(Judgment judgment) {
  switch (judgment) {
    case Judgment::better:
      return "✅";
    case Judgment::same:
      return "➖";
    case Judgment::worse:
      return "🔽";
    case Judgment::regression:
      return "❌";
    case Judgment::unclear:
      return "❔";
  }
  return "❔";
}

std::string judged(Judgment judgment) {
  return std::string{sign_of(judgment)} + " " + name_of(judgment);
}

std::string opening(const DiffReport& report) {
  const bool passed =
      report.judgment != Judgment::regression && report.judgment != Judgment::unclear;
  std::string text = fmt::format(
      "### stormproof diff: {} {}\n\n{} → {}. {}\n", passed ? "✅" : sign_of(report.judgment),
      headline(report), md_code(report.base.reference), md_code(report.candidate.reference),
      md_text(headline_sentence(report)));
  constexpr std::size_t most = 12;
  if (!report.reasons.empty()) text += "\n";
  for (std::size_t k = 0; k < std::min(most, report.reasons.size()); ++k) {
    text += "* " + md_text(report.reasons[k]) + "\n";
  }
  if (report.reasons.size() > most) {
    text += fmt::format("* and {} more\n", report.reasons.size() - most);
  }
  if (report.interrupted) text += "\nInterrupted: this is what was known until then.\n";
  return text;
}

std::string knobs(const DiffReport& report) {
  Rows rows;
  for (const KnobChange& change : report.profiles.changes) {
    std::string matters = matters_text(change);
    if (!change.why.empty()) matters += ": " + md_text(change.why);
    rows.push_back({md_code(change.key), md_code(change.before), md_code(change.after), matters});
  }
  if (rows.empty()) return "Every knob has the same value.\n";
  return "#### Knobs that differ\n\n" +
         md_table({"knob", "base", "candidate", "matters"}, "llll", rows);
}

std::string unmodelled(const DiffReport& report) {
  std::string text;
  for (const model::config::TracedProfile* side : {&report.base, &report.candidate}) {
    for (const auto& [setting, effect] : side->profile.unmodelled) {
      text += fmt::format("* {}, {}: {}\n", side == &report.base ? "base" : "candidate",
                          md_code(setting), md_text(effect));
    }
  }
  return text.empty() ? text : fmt::format("**{}:**\n\n{}", report::unmodelled_heading, text);
}

std::string medians(const MeasuredChange& change) {
  return md_text(fmt::format("{} → {}, {}", value_text(change.measure, change.before.median),
                             value_text(change.measure, change.after.median), change_text(change)));
}

std::string costs(const CostComparison& costs) {
  Rows rows;
  for (const Configuration& one : costs.configurations) {
    rows.push_back(
        {md_text(one.name), medians(one[Measure::completion]), medians(one[Measure::messages]),
         medians(one[Measure::repair_data]),
         one.identical_runs ? "the same runs" : judged(one[Measure::completion].judgment)});
  }
  if (rows.empty()) return {};
  return fmt::format("#### Medians over the grid {}\n\n", md_code(costs.grid)) +
         md_table({"configuration", "completion", "messages", "repair DATA", "completion is"},
                  "lllll", rows);
}

std::string crossings(const CostComparison& costs) {
  Rows rows;
  for (const Configuration& one : costs.configurations) {
    for (const LimitCrossing& crossing : one.crossings) {
      rows.push_back({md_code(crossing.text), md_text(one.name), share_text(crossing.before),
                      share_text(crossing.after), judged(crossing.judgment)});
    }
  }
  if (rows.empty()) return {};
  return "#### Limits, and the share of runs that exceed them\n\n" +
         md_table({"limit", "configuration", "base", "candidate", "judgment"}, "llrrl", rows);
}

std::string verdicts(const DiffReport& report, bool changed) {
  Rows rows;
  for (const VerdictChange& change : report.verdicts.properties) {
    if ((change.before != change.after) != changed) continue;
    rows.push_back({md_code(change.property), name_of(change.before), name_of(change.after),
                    judged(change.judgment)});
  }
  if (rows.empty()) return {};
  return md_table({"property", "base", "candidate", "judgment"}, "llll", rows);
}

std::string apart(const DiffReport& report) {
  const TellingApart& apart = report.telling_apart;
  if (!apart.found) return {};
  std::string body = md_text(apart.difference) + "\n";
  for (const bool candidate : {false, true}) {
    counterexample::Chart chart =
        counterexample::chart_of(candidate ? apart.candidate_run : apart.base_run,
                                 candidate ? apart.candidate_packets : apart.base_packets);
    const model::config::TracedProfile& profile = candidate ? report.candidate : report.base;
    chart.title = "the runs part";
    chart.sign = "≠";
    body +=
        fmt::format("\n{}: {}\n\n{}", candidate ? "Candidate" : "Base", md_code(profile.reference),
                    report::md_block("mermaid", counterexample::mermaid_chart(chart)));
  }
  return report::md_details("The least scenario that tells them apart", body);
}

std::string blame(const DiffReport& report) {
  if (!report.blame) return {};
  Rows rows;
  for (const Blame::Entry& entry : report.blame->entries) {
    std::string keys;
    for (const std::string& key : entry.reverted) keys += (keys.empty() ? "" : ", ") + md_code(key);
    rows.push_back({keys,
                    std::isnan(entry.completion_median)
                        ? "never"
                        : value_text(Measure::completion, entry.completion_median),
                    value_text(Measure::messages, entry.messages_median),
                    entry.cures ? "yes" : "no"});
  }
  return fmt::format("#### Which knob does it, at {}\n\n", md_text(report.blame->configuration)) +
         md_table({"set back to the base", "completion", "messages", "cures"}, "lrrl", rows);
}

void add_counterexamples(const DiffReport& report, const Files& files,
                         report::MarkdownDocument& document) {
  for (const VerdictChange& change : report.verdicts.properties) {
    if (change.before == change.after || !change.counterexample) continue;
    std::string body =
        md_text(change.counterexample->reason) + "\n\n" +
        report::md_block("mermaid", counterexample::mermaid_chart(*change.counterexample));
    const auto file = files.find(change.property);
    if (file != files.end()) {
      body += fmt::format("\nReplay it: {}\n", md_code("stormproof replay " + file->second));
    }
    document.add("the counterexample of " + change.property,
                 report::md_details("Counterexample of " + change.property, body));
  }
}

}  // namespace

std::string to_markdown(const DiffReport& report, const Files& files) {
  report::MarkdownDocument document;
  document.add("", opening(report));
  document.add("the knobs that differ", knobs(report));
  document.add("the unmodelled settings", unmodelled(report));
  const std::string changed = verdicts(report, true);
  if (!changed.empty()) {
    document.add("the changed verdicts", fmt::format("#### Verdicts that change, on {}\n\n{}",
                                                     md_code(report.verdicts.scenario), changed));
  }
  document.add("the limits", crossings(report.costs));
  document.add("the blame table", blame(report));
  document.add("the storm-free margin",
               fmt::format("Storm-free margin: {}. {}\n", judged(report.margin.judgment),
                           md_text(report.margin.reason)));
  const std::string table = costs(report.costs);
  if (!table.empty()) {
    document.add("the table of configurations",
                 report::md_details("Completion and messages, before and after", table));
  }
  document.add("the scenario that tells them apart", apart(report));
  add_counterexamples(report, files, document);
  const std::string kept = verdicts(report, false);
  if (!kept.empty()) {
    document.add("the other verdicts", report::md_details("Verdicts that do not change", kept));
  }
  if (!report.command.empty()) {
    document.add("the command", fmt::format("Repeat it: {}\n", md_code(report.command)));
  }
  return document.text("The HTML report shows everything.");
}

}  // namespace stormproof::diff
