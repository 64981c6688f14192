// A comparison as a document: the judgment and its reasons first, then each part.
#include <algorithm>
#include <cmath>

#include <fmt/core.h>

#include "checker/experiments/diff/diff_parts.hpp"
#include "checker/experiments/diff/summary.hpp"
#include "checker/experiments/diff/words.hpp"
#include "checker/presentation/document/unmodelled.hpp"
#include "checker/presentation/text/command_line.hpp"
#include "checker/presentation/text/numbers.hpp"
#include "checker/verification/counterexample/chart.hpp"
#include "checker/verification/counterexample/stepper.hpp"
#include "model/config/shown_path.hpp"
#include "props/monitors/describe.hpp"

namespace stormproof::diff {

namespace {

using report::Audience;
using report::Blocks;
using report::Bullets;
using report::code;
using report::Column;
using report::Document;
using report::Facts;
using report::Paragraph;
using report::Section;
using report::Table;
using report::Text;
using report::Tone;

Tone tone_of(Judgment judgment) {
  switch (judgment) {
    case Judgment::better:
      return Tone::good;
    case Judgment::same:
    case Judgment::worse:
      return Tone::info;
    case Judgment::regression:
      return Tone::bad;
    case Judgment::unclear:
      break;
  }
  return Tone::warn;
}

void add_reasons(Blocks& blocks, const DiffReport& report) {
  constexpr std::size_t most = 12;
  Bullets bullets;
  for (std::size_t k = 0; k < std::min(most, report.reasons.size()); ++k) {
    bullets.items.emplace_back(report.reasons[k]);
  }
  if (report.reasons.size() > most) {
    bullets.items.emplace_back(
        fmt::format("and {} more of this kind below", report.reasons.size() - most));
  }
  if (!bullets.items.empty()) blocks.emplace_back(std::move(bullets));
}

std::string place_text(const KnobChange& change) {
  const model::config::Place& place =
      change.after_place.source ? change.after_place : change.before_place;
  return place.source ? model::config::shown_place(place) : "";
}

void add_knobs(Blocks& blocks, const DiffReport& report) {
  Section section{"Knobs that differ", "knobs"};
  if (report.profiles.changes.empty()) {
    section.blocks.emplace_back(Paragraph{"None: every knob has the same value."});
    blocks.emplace_back(std::move(section), Audience::documents);
    return;
  }
  Table table{{{"knob"}, {"base"}, {"candidate"}, {"does it matter?", Column::Align::left, true}},
              {}};
  for (const KnobChange& change : report.profiles.changes) {
    std::string matters = matters_text(change);
    if (!change.modelled) matters += ", it is not in the model";
    if (!change.why.empty()) matters += ": " + change.why;
    Table::Row row{{code(change.key), code(change.before), code(change.after), matters},
                   change.matters};
    if (const std::string place = place_text(change); !place.empty()) {
      row.details.emplace_back(Paragraph{place}, Audience::terminal);
    }
    table.rows.push_back(std::move(row));
  }
  table.columns.push_back({"where", Column::Align::left, false, Audience::documents});
  for (std::size_t k = 0; k < table.rows.size(); ++k) {
    table.rows[k].cells.emplace_back(place_text(report.profiles.changes[k]));
  }
  section.blocks.emplace_back(std::move(table));
  blocks.emplace_back(std::move(section));
}

Table verdict_table(const VerdictComparison& verdicts, const Files& files, bool changed) {
  Table table{{{"judgment"}, {"property"}, {"base"}, {"candidate"}}, {}};
  for (const VerdictChange& change : verdicts.properties) {
    if ((change.before != change.after) != changed) continue;
    Table::Row row{{badge_of(change.judgment), code(change.property), props::name_of(change.before),
                    props::name_of(change.after)}};
    if (changed) {
      Facts facts{{{"statement", change.statement},
                   {"before", change.before_how},
                   {"after", change.after_how}}};
      if (change.counterexample) {
        facts.rows.emplace_back("because", change.counterexample->reason);
        const auto file = files.find(change.property);
        if (file != files.end()) {
          facts.rows.emplace_back("replay", code(report::command_line({"replay", file->second})));
        }
      }
      row.details.emplace_back(std::move(facts));
      row.summary = "How it was decided";
    }
    table.rows.push_back(std::move(row));
  }
  return table;
}

/// The counterexamples of verdicts that change, to walk through.
void add_counterexamples(Blocks& blocks, const VerdictComparison& verdicts,
                         std::set<std::string>& machines) {
  std::size_t number = 0;
  for (const VerdictChange& change : verdicts.properties) {
    if (change.before == change.after || !change.counterexample) continue;
    const char* side = change.after == props::VerdictKind::violated ? "candidate" : "base";
    Section section{fmt::format("{} with the {}", change.property, side)};
    section.folded_in_comments = true;
    section.blocks.emplace_back(counterexample::walk(
        *change.counterexample, counterexample::chart_of(*change.counterexample),
        fmt::format("verdict-{}", number++),
        fmt::format("How {} breaks with the {}", change.property, side), machines));
    blocks.emplace_back(std::move(section), Audience::documents);
  }
}

void add_verdicts(Blocks& blocks, const DiffReport& report, const Files& files) {
  const VerdictComparison& verdicts = report.verdicts;
  Section section{"Verdicts", "verdicts"};
  if (!verdicts.done) {
    section.blocks.emplace_back(
        Paragraph{report.unasked.lacked_time() ? "Left out." : "Left out by request."});
    blocks.emplace_back(std::move(section), Audience::documents);
    return;
  }
  Table changed = verdict_table(verdicts, files, true);
  const std::size_t all = verdicts.properties.size();
  const std::string same =
      fmt::format("{} of {} properties have the same verdict with both profiles ({}).",
                  all - changed.rows.size(), all, verdicts.scenario);
  if (!changed.rows.empty()) section.blocks.emplace_back(std::move(changed));
  section.blocks.emplace_back(Paragraph{same});
  std::set<std::string> machines;
  add_counterexamples(section.blocks, verdicts, machines);
  if (!machines.empty()) {
    section.blocks.emplace_back(counterexample::diagrams_of(machines), report::Audience::page);
  }
  Table others = verdict_table(verdicts, files, false);
  if (!others.rows.empty()) {
    Section kept{"Verdicts that do not change", "", {std::move(others)}, true};
    section.blocks.emplace_back(std::move(kept), Audience::documents);
  }
  blocks.emplace_back(std::move(section));
}

std::string margin_side(const Margin& margin) {
  std::string text = margin.unlimited   ? "no needless repair at any delay"
                     : margin.threshold ? "no needless repair at delays up to " +
                                              props::time_text(*margin.threshold)
                                        : "no delay rules out needless repairs";
  if (!margin.unlimited && !margin.formula.empty()) {
    text += margin.threshold ? " = " + margin.formula : " (" + margin.formula + ")";
  }
  if (!margin.load) return text + "; storms even in the least deployment of the grid";
  return text + fmt::format("; no storm up to {} descriptors ({})", report::grouped(*margin.load),
                            margin.load_configuration);
}

void add_margin(Blocks& blocks, const DiffReport& report) {
  const MarginComparison& margin = report.margin;
  if (report.costs.configurations.empty()) return;
  if (margin.before.formula.empty() && margin.reason.empty()) return;
  Facts facts{{{"before", margin_side(margin.before)}, {"after", margin_side(margin.after)}}};
  if (!margin.reason.empty()) {
    facts.rows.emplace_back("judgment", badge_of(margin.judgment) + ": " + margin.reason);
  }
  blocks.emplace_back(
      Section{"Storm-free margin", "margin", {std::move(facts), Paragraph{report.costs.storm}}});
}

void add_blame(Blocks& blocks, const DiffReport& report) {
  if (!report.blame) return;
  Table table{{{"set back to the base"},
               {"completion", Column::Align::right},
               {"messages", Column::Align::right},
               {"does it cure it?"}},
              {}};
  for (const Blame::Entry& entry : report.blame->entries) {
    Text keys;
    for (const std::string& key : entry.reverted) keys += (keys.empty() ? "" : " + ") + code(key);
    const std::string completion = std::isnan(entry.completion_median)
                                       ? "never"
                                       : value_text(Measure::completion, entry.completion_median);
    table.rows.push_back({{keys, completion, value_text(Measure::messages, entry.messages_median),
                           entry.cures ? "yes" : "no"},
                          entry.cures});
  }
  blocks.emplace_back(
      Section{"Which knob does it",
              "blame",
              {Paragraph{report.blame->configuration + ", with knobs set back to the base:"},
               std::move(table)}});
}

}  // namespace

Text badge_of(Judgment judgment) {
  const char* sign = judgment == Judgment::same ? "=" : judgment == Judgment::worse ? "↓" : "";
  return report::badge(tone_of(judgment), name_of(judgment), sign);
}

Document document_of(const DiffReport& report, const Files& files) {
  const Judgment judgment = report.judgment;
  const bool passed = judgment != Judgment::regression && judgment != Judgment::unclear;
  Document document;
  document.title =
      fmt::format("stormproof diff {} {}", report.base.reference, report.candidate.reference);
  document.tone = passed ? Tone::good : tone_of(judgment);
  document.exit_code = judgment == Judgment::regression                      ? 1
                       : judgment == Judgment::unclear || report.interrupted ? 3
                                                                             : 0;
  document.complete = !report.interrupted;
  document.seconds = report.seconds;
  document.answer = std::string{headline(report)} + ": " + headline_sentence(report);
  document.elaboration = fmt::format("{} → {}, policy {}", report.base.reference,
                                     report.candidate.reference, report.policy.name);
  Blocks& blocks = document.blocks;
  add_reasons(blocks, report);
  Facts unasked;
  add_unasked(unasked, report.unasked);
  if (!unasked.rows.empty()) blocks.emplace_back(std::move(unasked));
  add_comment_chart(blocks, report);
  add_knobs(blocks, report);
  add_verdicts(blocks, report, files);
  add_rollouts(blocks, report);
  add_costs(blocks, report);
  add_margin(blocks, report);
  add_blame(blocks, report);
  add_apart(blocks, report, files);
  add_findings(document, report, files);
  add_unmodelled(document, report.base.value, report.base.reference);
  if (report.candidate.value.unmodelled != report.base.value.unmodelled) {
    add_unmodelled(document, report.candidate.value, report.candidate.reference);
  }
  return document;
}

}  // namespace stormproof::diff
