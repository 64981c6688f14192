// A check as GitHub's Markdown: what a comment on a pull request says about it.
#include <fmt/format.h>

#include "checker/presentation/document/markdown.hpp"
#include "checker/presentation/text/assumptions.hpp"
#include "checker/presentation/text/plain_text.hpp"
#include "checker/verification/check/check_report.hpp"
#include "checker/verification/counterexample/chart.hpp"

namespace stormproof::checker {

namespace {

using props::Finding;
using props::VerdictKind;
using report::md_code;
using report::md_text;

const char* sign_of(VerdictKind kind) {
  switch (kind) {
    case VerdictKind::violated:
      return "❌";
    case VerdictKind::inconclusive:
      return "❔";
    case VerdictKind::proved:
    case VerdictKind::bounded:
    case VerdictKind::sampled:
      return "✅";
  }
  return "❔";
}

std::string headline(const CheckReport& report, const CheckContext& context) {
  const std::size_t violated = report.count(VerdictKind::violated);
  const std::size_t open = report.count(VerdictKind::inconclusive);
  std::string line =
      violated > 0 ? fmt::format("❌ {} of {} properties violated", violated, report.results.size())
      : open > 0 ? fmt::format("❔ {} of {} properties inconclusive", open, report.results.size())
                 : fmt::format("✅ all {} properties hold", report.results.size());
  std::string text = fmt::format("### stormproof check {}: {}\n\n", md_code(context.name), line);
  std::string counts;
  for (const VerdictKind kind : {VerdictKind::proved, VerdictKind::bounded, VerdictKind::sampled,
                                 VerdictKind::violated, VerdictKind::inconclusive}) {
    if (report.count(kind) == 0) continue;
    counts += fmt::format("{}{} {}", counts.empty() ? "" : ", ", report.count(kind), name_of(kind));
  }
  text +=
      fmt::format("{}; {}.\n", counts,
                  report::plural(context.scenario.deployment.participants.size(), "participant"));
  if (report.interrupted) text += "\nInterrupted: what was not checked is inconclusive.\n";
  return text;
}

std::string sentence_of(const PropertyResult& result) {
  const props::Counterexample* counterexample = result.counterexample();
  if (counterexample != nullptr) return counterexample->reason;
  return result.decisive().how;
}

/// The properties whose verdict is `wanted` or not.
std::string table(const CheckReport& report, bool problems) {
  std::vector<std::vector<std::string>> rows;
  for (const PropertyResult& result : report.results) {
    const bool problem =
        result.verdict == VerdictKind::violated || result.verdict == VerdictKind::inconclusive;
    if (problem != problems) continue;
    rows.push_back({fmt::format("{} {}", sign_of(result.verdict), name_of(result.verdict)),
                    md_code(result.property->id), md_text(sentence_of(result))});
  }
  if (rows.empty()) return {};
  return report::md_table({"verdict", "property", problems ? "why" : "how"}, "lll", rows);
}

std::string assumptions(const CheckReport& report) {
  std::string text;
  for (const PropertyResult& result : report.results) {
    for (const std::string& line : result.decisive().assumptions) {
      text += fmt::format("* {}: {}\n", md_code(result.property->id), md_text(line));
    }
  }
  return text.empty() ? text : report::md_details("Assumptions", text);
}

std::string unmodelled(const model::DdsProfile& dds) {
  if (dds.unmodelled.empty()) return {};
  std::string text = fmt::format("**{}:**\n\n", report::unmodelled_heading);
  for (const auto& [setting, effect] : dds.unmodelled) {
    text += fmt::format("* {}: {}\n", md_code(setting), md_text(effect));
  }
  return text;
}

void add_violation(report::MarkdownDocument& document, const PropertyResult& result,
                   const CheckContext& context) {
  const props::Counterexample* found = result.counterexample();
  if (found == nullptr) return;
  const std::string id{result.property->id};
  std::string chart = report::md_block("mermaid", counterexample::mermaid_chart(*found));
  const auto file = context.counterexamples.find(id);
  if (file != context.counterexamples.end()) {
    chart += fmt::format("\nReplay it: {}\n", md_code("stormproof replay " + file->second));
  }
  document.add("the sequence chart of " + id, report::md_details("Sequence chart of " + id, chart));
  const auto story = context.stories.find(id);
  if (story == context.stories.end()) return;
  document.add("the story of " + id,
               report::md_details("Story of " + id, report::md_block("text", story->second)));
}

}  // namespace

std::string to_markdown(const CheckReport& report, const CheckContext& context) {
  report::MarkdownDocument document;
  document.add("", headline(report, context));
  document.add("", table(report, true));
  document.add("the unmodelled settings", unmodelled(context.scenario.dds));
  const std::string holding = table(report, false);
  if (!holding.empty()) {
    document.add("the properties that hold", report::md_details("What holds, and how", holding));
  }
  for (const PropertyResult& result : report.results) {
    if (result.verdict == VerdictKind::violated) add_violation(document, result, context);
  }
  document.add("the assumptions", assumptions(report));
  if (!context.command.empty()) {
    document.add("the command", fmt::format("Repeat it: {}\n", md_code(context.command)));
  }
  return document.text("The HTML report shows everything.");
}

}  // namespace stormproof::checker
