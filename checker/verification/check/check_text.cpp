// A check for a person at a terminal: verdicts first, then what is violated and why.
#include <fmt/core.h>

#include "checker/presentation/text/assumptions.hpp"
#include "checker/presentation/text/numbers.hpp"
#include "checker/presentation/text/paragraph.hpp"
#include "checker/verification/check/check_report.hpp"

namespace stormproof::checker {

namespace {

using props::Finding;
using props::VerdictKind;
using report::left;
using report::paragraph;

constexpr std::size_t verdict_columns = 14;
constexpr std::size_t id_columns = 29;

std::string shown(VerdictKind kind) {
  return kind == VerdictKind::violated ? "VIOLATED" : name_of(kind);
}

std::string indent(std::size_t columns, const char* tail = "") {
  return std::string(columns, ' ') + tail;
}

/// "tables: no two rows …"
std::string method(const Finding& finding) {
  return finding.engine.empty() ? finding.how : finding.engine + ": " + finding.how;
}

std::string result_text(const PropertyResult& result, const CheckContext& context) {
  const bool verbose = context.verbose;
  const Finding& decisive = result.decisive();
  const std::size_t margin = verdict_columns + id_columns;
  std::string text = paragraph(left(shown(result.verdict), verdict_columns) +
                                   left(std::string{result.property->id}, id_columns),
                               method(decisive));
  if (verbose) {
    text += paragraph(indent(margin),
                      statement_of(*result.property, context.scenario.dds.implementation));
  }
  for (const std::string& assumption : decisive.assumptions) {
    text += paragraph(indent(margin, "assuming "), assumption);
  }
  if (verbose) {
    for (const std::string& line : decisive.details) text += indent(4) + line + "\n";
    if (!decisive.solver.empty()) {
      text += fmt::format("{}{}, seed {}, {:.3f} s\n", indent(4), decisive.solver, decisive.seed,
                          decisive.seconds);
    }
  }
  for (const Finding& other : result.findings) {
    if (&other == &decisive) continue;
    if (!verbose && result.verdict != VerdictKind::inconclusive) continue;
    text += paragraph(indent(margin, "also ") + name_of(other.kind) + ", ", method(other));
    for (const std::string& line : other.details) text += indent(4) + line + "\n";
  }
  return text;
}

std::string violation_text(const PropertyResult& result, const CheckContext& context) {
  const std::string id{result.property->id};
  std::string text = fmt::format("\n{}\n", std::string(report::report_width, '-'));
  const auto story = context.stories.find(id);
  if (story != context.stories.end()) {
    text += story->second;
  } else {
    text +=
        paragraph("VIOLATED ",
                  id + ": " + statement_of(*result.property, context.scenario.dds.implementation));
    text += paragraph("  because ", result.decisive().how);
  }
  if (story == context.stories.end() || context.verbose) {
    for (const std::string& line : result.decisive().details) text += indent(4) + line + "\n";
  }
  const auto file = context.counterexamples.find(id);
  if (file != context.counterexamples.end()) {
    text += fmt::format("\n  replay it: stormproof replay {}\n", file->second);
  }
  return text;
}

std::string summary_text(const CheckReport& report) {
  std::string text;
  for (const VerdictKind kind : {VerdictKind::proved, VerdictKind::bounded, VerdictKind::sampled,
                                 VerdictKind::violated, VerdictKind::inconclusive}) {
    const std::size_t count = report.count(kind);
    if (count == 0) continue;
    text += fmt::format("{}{} {}", text.empty() ? "" : ", ", count, name_of(kind));
  }
  return text + fmt::format(" ({:.1f} s)\n", report.seconds);
}

}  // namespace

std::string to_text(const CheckReport& report, const CheckContext& context) {
  const bool fastdds = context.scenario.dds.implementation == model::ImplementationKind::fastdds;
  std::string text = fmt::format(
      "{}: {} participants, {}\n\n", context.name, context.scenario.deployment.participants.size(),
      fastdds ? "Fast DDS's own rules" : "the rules of the closed-loop model");
  for (const PropertyResult& result : report.results) {
    text += result_text(result, context);
  }
  for (const PropertyResult& result : report.results) {
    if (result.verdict == VerdictKind::violated) text += violation_text(result, context);
  }
  text += report::unmodelled_text(context.scenario.dds);
  text += "\n" + summary_text(report);
  if (report.interrupted) text += "Interrupted: what was not checked is inconclusive.\n";
  return text;
}

}  // namespace stormproof::checker
