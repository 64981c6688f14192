// A check as one HTML page: verdicts first, then each violation as a chart to step through.
#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "checker/presentation/document/html_page.hpp"
#include "checker/presentation/document/html_parts.hpp"
#include "checker/presentation/text/numbers.hpp"
#include "checker/presentation/text/plain_text.hpp"
#include "checker/verification/check/check_report.hpp"
#include "checker/verification/check/origins.hpp"
#include "checker/verification/check/run_plots.hpp"
#include "checker/verification/counterexample/stepper.hpp"
#include "model/config/knobs/effective.hpp"

namespace stormproof::checker {

namespace {

using props::Finding;
using props::VerdictKind;
using report::Drawings;
using report::html_text;
using report::Tone;

constexpr std::array all_kinds{VerdictKind::violated, VerdictKind::inconclusive,
                               VerdictKind::proved, VerdictKind::bounded, VerdictKind::sampled};

std::string summary_html(const CheckReport& report, const CheckContext& context) {
  const std::size_t violated = report.count(VerdictKind::violated);
  const std::size_t open = report.count(VerdictKind::inconclusive);
  const std::size_t all = report.results.size();
  const bool fastdds = context.scenario.dds.implementation == model::ImplementationKind::fastdds;
  const Tone tone = violated > 0 ? Tone::bad : open > 0 ? Tone::warn : Tone::good;
  const std::string line =
      violated > 0 ? fmt::format("✗ {} of {} properties are violated", violated, all)
      : open > 0   ? fmt::format("? {} of {} properties are inconclusive", open, all)
                   : fmt::format("✓ all {} properties hold", all);
  std::string html = report::parts::paragraph_html(fmt::format(
      "{}, {}; {:.1f} s of checking.",
      report::plural(context.scenario.deployment.participants.size(), "participant"),
      fastdds ? "Fast DDS's own rules" : "the rules of the closed-loop model", report.seconds));
  if (report.interrupted) {
    html += report::parts::paragraph_html("Interrupted: what was not checked is inconclusive.");
  }
  std::string counts = "<ul class=\"counts\" aria-label=\"Verdicts\">\n";
  for (const VerdictKind kind : all_kinds) {
    if (report.count(kind) == 0) continue;
    counts += "<li>" +
              report::parts::badge(
                  report::parts::tone_of(kind),
                  fmt::format("{}: {}", report::parts::signed_name(kind), report.count(kind))) +
              "</li>\n";
  }
  return report::parts::banner(tone, line, html) + counts + "</ul>\n";
}

/// The findings of all engines, folded.
std::string findings_html(const PropertyResult& result) {
  std::string html;
  for (const Finding& finding : result.findings) {
    std::string line = finding.engine.empty() ? "" : finding.engine + ", ";
    line += fmt::format("{}: {}", name_of(finding.kind), finding.how);
    html += "<p>" + html_text(line) + "</p>\n";
    std::vector<std::string> assumptions;
    for (const std::string& one : finding.assumptions) assumptions.push_back("assuming " + one);
    html += report::parts::bullets(assumptions);
    std::string lines;
    for (const std::string& one : finding.details) lines += one + "\n";
    if (!lines.empty()) html += report::parts::preformatted(lines);
  }
  const std::size_t count = result.decisive().assumptions.size();
  const std::string assumed = count == 0 ? "no assumptions" : report::plural(count, "assumption");
  return report::parts::details(assumed + ", " + report::plural(result.findings.size(), "finding"),
                                html);
}

std::string verdicts_html(const CheckReport& report, const CheckContext& context) {
  report::parts::HtmlTable table;
  table.head = {"verdict", "property", "what it says", "how it was decided"};
  table.align = "ttll";
  table.stacked_on_paper = true;
  for (const VerdictKind kind : all_kinds) {
    for (const PropertyResult& result : report.results) {
      if (result.verdict != kind) continue;
      const std::string id{result.property->id};
      const bool shown = kind == VerdictKind::violated && result.counterexample() != nullptr;
      const std::string name = report::parts::code(id);
      table.rows.push_back(
          {report::parts::badge(report::parts::tone_of(kind), report::parts::signed_name(kind)),
           shown ? fmt::format("<a href=\"#{}\">{}</a>", html_text(id), name) : name,
           html_text(statement_of(*result.property, context.scenario.dds.implementation)),
           html_text(result.decisive().how) + findings_html(result)});
    }
  }
  return report::parts::heading("Verdicts", "verdicts") + to_html(table);
}

std::string violation_html(const PropertyResult& result, const CheckContext& context,
                           std::size_t number, Drawings& drawings,
                           std::set<std::string>& machines) {
  const std::string id{result.property->id};
  const props::Counterexample& found = *result.counterexample();
  std::string html = fmt::format("<section aria-labelledby=\"{0}\">\n<h3 id=\"{0}\">{1}</h3>\n",
                                 html_text(id), html_text("✗ " + id));
  html += report::parts::paragraph_html(
      statement_of(*result.property, context.scenario.dds.implementation));
  html += report::parts::banner(Tone::bad, found.reason);
  html += report::walk_html(found, counterexample::chart_of(found), fmt::format("chart-{}", number),
                            "How " + id + " breaks", drawings, machines);
  const auto story = context.stories.find(id);
  if (story != context.stories.end()) {
    html +=
        report::parts::details("The same as a story", report::parts::preformatted(story->second));
  }
  const auto file = context.counterexamples.find(id);
  if (file != context.counterexamples.end()) {
    html += "<p>Replay it through the state machines:</p>\n" +
            report::parts::preformatted("stormproof replay " + file->second);
  }
  return html + "</section>\n";
}

std::string violations_html(const CheckReport& report, const CheckContext& context,
                            Drawings& drawings) {
  std::string html;
  std::set<std::string> machines;
  std::size_t number = 0;
  for (const PropertyResult& result : report.results) {
    if (result.verdict != VerdictKind::violated || result.counterexample() == nullptr) continue;
    html += violation_html(result, context, number++, drawings, machines);
  }
  if (html.empty()) return {};
  return report::parts::heading("What breaks, step by step", "violations") + html +
         machines_html(machines, drawings);
}

std::string run_html(const model::Scenario& scenario, Drawings& drawings) {
  const report::RunPlots plots = report::run_plots(scenario);
  std::string html = report::parts::heading("The run of the scenario", "run") +
                     report::parts::paragraph_html(plots.note) + "<div class=\"plots\">\n";
  for (const std::string& svg : plots.drawings) html += drawings.add(svg);
  return html + "</div>\n";
}

void add_knobs(report::parts::HtmlTable& table, const nlohmann::ordered_json& value,
               const std::string& key, const CheckContext& context, const std::string& file) {
  if (value.is_object() && !value.empty() && key != "dds.unmodelled") {
    for (const auto& [name, part] : value.items()) {
      add_knobs(table, part, key.empty() ? name : key + "." + name, context, file);
    }
    return;
  }
  if (key == "dds.unmodelled") return;
  const auto place = context.places.find(key);
  const bool known = place != context.places.end();
  table.marked.push_back(known && by_user(place->second, file));
  table.rows.push_back({report::parts::code(key),
                        html_text(value.is_string() ? value.get<std::string>() : value.dump()),
                        html_text(known ? origin_text(place->second) : "default")});
}

std::string profile_html(const CheckContext& context) {
  const std::string file = scenario_file(context.places, context.name);
  report::parts::HtmlTable table;
  table.caption = "Every value that the runs used. Shaded: set by the scenario's own files.";
  table.head = {"key", "value", "where it comes from"};
  table.align = "lll";
  add_knobs(table, model::config::effective_json(context.scenario.dds), "dds", context, file);
  add_knobs(table, model::config::effective_json(context.scenario.wireless), "wireless", context,
            file);
  return report::parts::heading("Effective profiles", "profile") +
         report::parts::details("DDS and wireless profile, with the origin of each value",
                                to_html(table));
}

std::string repeat_html(const CheckContext& context) {
  if (context.command.empty()) return {};
  return report::parts::heading("Repeat it", "repeat") +
         report::parts::preformatted(context.command);
}

}  // namespace

std::string to_html(const CheckReport& report, const CheckContext& context) {
  Drawings drawings;
  const std::string title = "stormproof check " + context.name;
  std::string body = "<h1>" + html_text(title) + "</h1>\n";
  body += summary_html(report, context);
  body += report::parts::unmodelled_html(context.scenario.dds, "");
  body += verdicts_html(report, context);
  body += violations_html(report, context, drawings);
  body += run_html(context.scenario, drawings);
  body += profile_html(context);
  body += repeat_html(context);
  return report::html_page(title, body, drawings);
}

}  // namespace stormproof::checker
