// A comparison as one HTML page: the judgment first, then what led to it, part by part.
#include <cmath>

#include <fmt/format.h>

#include "checker/experiments/diff/diff_html_parts.hpp"
#include "checker/experiments/diff/summary.hpp"
#include "checker/experiments/diff/words.hpp"
#include "checker/presentation/document/html_page.hpp"
#include "checker/presentation/document/html_parts.hpp"
#include "checker/presentation/text/numbers.hpp"
#include "checker/verification/counterexample/stepper.hpp"

namespace stormproof::diff {

namespace {

using report::Drawings;
using report::html_text;
using report::Tone;
using report::parts::code;
using report::parts::heading;
using report::parts::HtmlTable;
using report::parts::paragraph_html;

std::string signed_name(Judgment judgment) {
  const char* sign = judgment == Judgment::better       ? "✓ "
                     : judgment == Judgment::same       ? "= "
                     : judgment == Judgment::worse      ? "↓ "
                     : judgment == Judgment::regression ? "✗ "
                                                        : "? ";
  return sign + std::string{name_of(judgment)};
}

std::string judgment_html(const DiffReport& report) {
  const Judgment judgment = report.judgment;
  const bool passed = judgment != Judgment::regression && judgment != Judgment::unclear;
  const char* sign = passed ? "✓" : judgment == Judgment::unclear ? "?" : "✗";
  std::string html = paragraph_html(headline_sentence(report)) +
                     report::parts::bullets(report.reasons) +
                     paragraph_html(fmt::format("Policy {}; {:.1f} s of comparing.",
                                                report.policy.name, report.seconds));
  return report::parts::banner(passed ? Tone::good : tone_of(judgment),
                               fmt::format("{} {}", sign, headline(report)), html);
}

std::string value_cell(const std::string& value, const model::config::Place& place) {
  std::string cell = code(value);
  if (place.source != nullptr) {
    cell += "<br><span class=\"soft\">" + html_text(place.to_string()) + "</span>";
  }
  return cell;
}

std::string knobs_html(const DiffReport& report) {
  const Comparison& profiles = report.profiles;
  std::string html = heading("Knobs that differ", "knobs");
  if (!profiles.proof.empty()) html += paragraph_html(profiles.proof);
  if (profiles.changes.empty())
    return html + paragraph_html("None: every knob has the same value.");
  HtmlTable table;
  table.head = {"knob", "base", "candidate", "does it matter?"};
  for (const KnobChange& change : profiles.changes) {
    const std::string why = change.why.empty() ? "" : ": " + change.why;
    table.rows.push_back({code(change.key), value_cell(change.before, change.before_place),
                          value_cell(change.after, change.after_place),
                          html_text(matters_text(change) + why)});
    table.marked.push_back(change.matters);
  }
  return html + to_html(table);
}

std::string margin_text(const Margin& margin) {
  std::string text = margin.unlimited   ? "no delay is too long"
                     : margin.threshold ? "delays up to " + report::duration(*margin.threshold)
                                        : "no threshold";
  if (!margin.formula.empty()) text += " (" + margin.formula + ")";
  if (margin.load) {
    text += fmt::format("; no storm up to {} descriptors ({})", report::grouped(*margin.load),
                        margin.load_configuration);
  } else {
    text += "; even the least configuration storms";
  }
  return text;
}

std::string margin_html(const DiffReport& report) {
  HtmlTable table;
  table.head = {"profile", "storm-free up to"};
  table.rows = {{"base", html_text(margin_text(report.margin.before))},
                {"candidate", html_text(margin_text(report.margin.after))}};
  return heading("Storm-free margin", "margin") + "<p>" + judgment_badge(report.margin.judgment) +
         " " + html_text(report.margin.reason) + "</p>\n" + to_html(table);
}

std::string blame_html(const DiffReport& report) {
  if (!report.blame) return {};
  HtmlTable table;
  table.caption = "At " + report.blame->configuration +
                  ": the candidate with single knobs set back to the base.";
  table.head = {"set back", "completion", "messages", "does it cure the regression?"};
  table.align = "lrrl";
  for (const Blame::Entry& entry : report.blame->entries) {
    std::string keys;
    for (const std::string& key : entry.reverted) keys += (keys.empty() ? "" : ", ") + code(key);
    const double completion = entry.completion_median;
    table.rows.push_back(
        {keys,
         html_text(std::isnan(completion) ? "never" : value_text(Measure::completion, completion)),
         html_text(value_text(Measure::messages, entry.messages_median)),
         entry.cures ? "yes" : "no"});
    table.marked.push_back(entry.cures);
  }
  return heading("Which knob does it", "blame") + to_html(table);
}

std::string machines_html(const std::set<std::string>& machines, Drawings& drawings) {
  const report::Section section = counterexample::diagrams_of(machines);
  std::string html;
  for (const report::Block& block : section.blocks) {
    const auto& drawing = std::get<report::Drawing>(block.content);
    html += fmt::format("<div data-machine=\"{}\">{}</div>\n", drawing.machine,
                        report::parts::drawing_html(drawings.add(drawing.svg), drawing.caption));
  }
  return html.empty() ? html : report::parts::details(section.title, html);
}

}  // namespace

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
      return Tone::warn;
  }
  return Tone::warn;
}

std::string judgment_badge(Judgment judgment) {
  return report::parts::badge(tone_of(judgment), signed_name(judgment));
}

std::string to_html(const DiffReport& report, const Files& files) {
  Drawings drawings;
  std::set<std::string> machines;
  const std::string title =
      fmt::format("stormproof diff {} → {}", report.base.reference, report.candidate.reference);
  std::string body = "<h1>" + html_text(title) + "</h1>\n" + judgment_html(report);
  if (report.interrupted) {
    body += report::parts::banner(Tone::warn, "? Interrupted: this is what was known until then");
  }
  body += report::parts::unmodelled_html(report.base.profile, "Base");
  body += report::parts::unmodelled_html(report.candidate.profile, "Candidate");
  body += knobs_html(report) + costs_html(report, drawings) + margin_html(report);
  body += verdicts_html(report, files, drawings, machines);
  body += apart_html(report, files, drawings, machines) + machines_html(machines, drawings);
  body += blame_html(report);
  body += heading("Repeat it", "repeat") + report::parts::preformatted(report.command);
  return report::html_page(title, body, drawings);
}

}  // namespace stormproof::diff
