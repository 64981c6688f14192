// A comparison for a person at a terminal: the judgment and its reasons first, then each part.
#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "checker/experiments/diff/cost_text.hpp"
#include "checker/experiments/diff/diff_report.hpp"
#include "checker/experiments/diff/summary.hpp"
#include "checker/experiments/diff/words.hpp"
#include "checker/presentation/text/assumptions.hpp"
#include "checker/presentation/text/numbers.hpp"
#include "checker/presentation/text/paragraph.hpp"
#include "checker/verification/counterexample/story.hpp"
#include "props/monitors/describe.hpp"

namespace stormproof::diff {

namespace {

using report::left;
using report::paragraph;
using report::right;

constexpr std::size_t shown_reasons = 6;

std::string heading(const char* text) { return fmt::format("\n{}\n", text); }

std::string judgment_text(const DiffReport& report) {
  std::string text = paragraph(std::string{headline(report)} + ": ", headline_sentence(report));
  text += fmt::format("  {} → {}, policy {}\n", report.base.reference, report.candidate.reference,
                      report.policy.name);
  const std::size_t shown = std::min(report.reasons.size(), shown_reasons);
  for (std::size_t k = 0; k < shown; ++k) text += paragraph("  • ", report.reasons[k]);
  if (report.reasons.size() > shown) {
    text += fmt::format("  • and {} more of this kind below\n", report.reasons.size() - shown);
  }
  return text;
}

std::string place_text(const KnobChange& change) {
  if (change.after_place.source) return change.after_place.to_string();
  return change.before_place.source ? change.before_place.to_string() : "";
}

std::string knobs_text(const DiffReport& report) {
  if (report.profiles.changes.empty()) return "";
  std::string text = heading("knobs that differ");
  for (const KnobChange& change : report.profiles.changes) {
    constexpr std::size_t key_columns = 38;
    const char* remark = change.matters    ? ""
                         : change.modelled ? "  (makes no difference)"
                                           : "  (not in the model)";
    text += paragraph("  " + left(change.key, key_columns) + " ",
                      fmt::format("{} → {}{}", change.before, change.after, remark));
    const std::string indent(key_columns + 3, ' ');
    if (const std::string place = place_text(change); !place.empty()) text += indent + place + "\n";
    if (!change.why.empty()) text += paragraph(indent, change.why);
  }
  return text;
}

std::string verdicts_text(const DiffReport& report, const Files& files) {
  const VerdictComparison& verdicts = report.verdicts;
  if (!verdicts.done) return "";
  std::string text = heading("verdicts");
  std::size_t changed = 0;
  for (const VerdictChange& change : verdicts.properties) {
    if (change.before == change.after) continue;
    ++changed;
    text += fmt::format("  {}{}{} → {}\n", left(name_of(change.judgment), 12),
                        left(change.property, 30), props::name_of(change.before),
                        props::name_of(change.after));
    text += paragraph("              ", change.statement);
    text += paragraph("      before  ", change.before_how);
    text += paragraph("      after   ", change.after_how);
    if (change.counterexample) {
      text += paragraph("      because ", change.counterexample->reason);
      const auto file = files.find(change.property);
      if (file != files.end()) text += "      replay  stormproof replay " + file->second + "\n";
    }
  }
  const std::size_t all = verdicts.properties.size();
  text +=
      paragraph("  ", fmt::format("{} of {} properties have the same verdict with both profiles "
                                  "({}).",
                                  all - changed, all, verdicts.scenario));
  return text;
}

std::string margin_side(const Margin& margin) {
  std::string text = fmt::format("no delay rules out needless repairs ({}); ", margin.formula);
  if (margin.unlimited) text = "no needless repair at any delay; ";
  if (margin.threshold) {
    text = fmt::format("no needless repair at delays up to {} = {}; ",
                       props::time_text(*margin.threshold), margin.formula);
  }
  if (!margin.load) return text + "storms even in the least deployment of the grid";
  return text + fmt::format("no storm up to {} descriptors ({})", report::grouped(*margin.load),
                            margin.load_configuration);
}

std::string margin_text(const DiffReport& report) {
  if (report.costs.configurations.empty()) return "";
  const MarginComparison& margin = report.margin;
  if (margin.before.formula.empty() && margin.after.formula.empty()) return "";
  std::string text = heading("storm-free margin");
  text += paragraph("  before      ", margin_side(margin.before));
  text += paragraph("  after       ", margin_side(margin.after));
  if (!margin.reason.empty()) {
    text += paragraph("  " + left(name_of(margin.judgment), 12), margin.reason);
  }
  return text;
}

std::string keys_text(const Blame::Entry& entry) {
  std::string keys;
  for (const std::string& key : entry.reverted) keys += (keys.empty() ? "" : " + ") + key;
  return keys;
}

std::string blame_text(const DiffReport& report) {
  if (!report.blame) return "";
  std::string text = heading("which knob does it");
  text += paragraph("  ", report.blame->configuration + ", with knobs set back to the base:");
  std::size_t width = 0;
  for (const Blame::Entry& entry : report.blame->entries) {
    width = std::max(width, keys_text(entry).size());
  }
  text +=
      fmt::format("  {}{}{}\n", left("", width), right("completion", 11), right("messages", 12));
  for (const Blame::Entry& entry : report.blame->entries) {
    const std::string keys = keys_text(entry);
    const std::string completion = std::isnan(entry.completion_median)
                                       ? "never"
                                       : value_text(Measure::completion, entry.completion_median);
    text += fmt::format("  {}{}{}{}\n", left(keys, width), right(completion, 11),
                        right(value_text(Measure::messages, entry.messages_median), 12),
                        entry.cures ? "  cures it" : "");
  }
  return text;
}

std::string telling_apart_text(const DiffReport& report, const Files& files) {
  const TellingApart& apart = report.telling_apart;
  if (apart.how.empty() && !apart.found) return "";
  std::string text = heading("the smallest scenario that tells them apart");
  if (!apart.found) return text + paragraph("  ", apart.how);
  text += paragraph("  scenario    ", counterexample::deployment_text(apart.scenario));
  text += paragraph("  difference  ", apart.difference);
  const auto side = [&](const char* name, const props::Counterexample& run) {
    return paragraph(fmt::format("  {}", left(name, 12)),
                     fmt::format("event {}: {}", report::grouped(run.event), run.reason));
  };
  text += side("base", apart.base_run) + side("candidate", apart.candidate_run);
  text += paragraph("  search      ",
                    fmt::format("{} ({} tried{})", apart.how, plural(apart.tried, "scenario"),
                                apart.finished ? "" : ", the effort was spent"));
  const char* first = "  files       ";
  for (const auto& [what, file] : files) {
    if (!what.starts_with("telling-apart")) continue;
    text += first + file + "\n";
    first = "              ";
  }
  return text;
}

}  // namespace

std::string to_text(const DiffReport& report, const Files& files, bool verbose) {
  std::string text = judgment_text(report);
  text += knobs_text(report);
  text += verdicts_text(report, files);
  text += costs_text(report, verbose);
  text += margin_text(report);
  text += blame_text(report);
  text += telling_apart_text(report, files);
  text += report::unmodelled_text(report.base.profile, report.base.reference);
  if (report.candidate.profile.unmodelled != report.base.profile.unmodelled) {
    text += report::unmodelled_text(report.candidate.profile, report.candidate.reference);
  }
  if (!report.command.empty()) text += fmt::format("\nrepeat it with: {}\n", report.command);
  return text;
}

}  // namespace stormproof::diff
