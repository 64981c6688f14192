// The runs behind a comparison, as HTML: counterexamples of verdicts that change, and the least
// scenario that tells the profiles apart.
#include <fmt/format.h>

#include "checker/experiments/diff/diff_html_parts.hpp"
#include "checker/presentation/document/html_page.hpp"
#include "checker/verification/counterexample/chart.hpp"
#include "checker/verification/counterexample/stepper.hpp"

namespace stormproof::diff {

using report::Drawings;
using report::html_text;
using report::parts::code;
using report::parts::heading;
using report::parts::HtmlTable;
using report::parts::paragraph_html;

namespace {

std::string walk_html(const props::Counterexample& run, const counterexample::Chart& chart,
                      const std::string& id, const std::string& caption, Drawings& drawings,
                      std::set<std::string>& machines) {
  const report::Sequence walk = counterexample::walk(run, chart, id, caption, machines);
  return "<div class=\"walk\">\n" +
         report::parts::drawing_html(drawings.add(counterexample::svg_chart(chart), id), caption) +
         walk.steps_html + "</div>\n";
}

}  // namespace

std::string verdicts_html(const DiffReport& report, const Files& files, Drawings& drawings,
                          std::set<std::string>& machines) {
  const VerdictComparison& verdicts = report.verdicts;
  std::string html = heading("Verdicts of the catalogue", "verdicts");
  if (!verdicts.done) return html + paragraph_html("Left out by request.");
  html += paragraph_html("On the scenario " + verdicts.scenario + ".");
  HtmlTable table;
  table.head = {"property", "base", "candidate", "judgment", "what it says"};
  table.align = "ttttl";
  std::string charts;
  std::size_t number = 0;
  for (const VerdictChange& change : verdicts.properties) {
    const auto verdict = [](props::VerdictKind kind) {
      return report::parts::badge(report::parts::tone_of(kind), report::parts::signed_name(kind));
    };
    table.rows.push_back({code(change.property), verdict(change.before), verdict(change.after),
                          judgment_badge(change.judgment), html_text(change.statement)});
    table.marked.push_back(change.before != change.after);
    if (change.before == change.after || !change.counterexample) continue;
    const std::string side =
        change.after == props::VerdictKind::violated ? "the candidate" : "the base";
    charts += "<h3>" + html_text("✗ " + change.property + " with " + side) + "</h3>\n" +
              walk_html(*change.counterexample, counterexample::chart_of(*change.counterexample),
                        fmt::format("verdict-{}", number++),
                        "How " + change.property + " breaks with " + side, drawings, machines);
    const auto file = files.find(change.property);
    if (file != files.end())
      charts += report::parts::preformatted("stormproof replay " + file->second);
  }
  return html + to_html(table) + charts;
}

std::string apart_html(const DiffReport& report, const Files& files, Drawings& drawings,
                       std::set<std::string>& machines) {
  const TellingApart& apart = report.telling_apart;
  std::string html = heading("The least scenario that tells them apart", "apart") +
                     paragraph_html(apart.found ? apart.difference : apart.how);
  if (!apart.found) return html;
  html += paragraph_html(apart.how, "soft");
  const auto add = [&](bool candidate) {
    counterexample::Chart chart =
        counterexample::chart_of(candidate ? apart.candidate_run : apart.base_run,
                                 candidate ? apart.candidate_packets : apart.base_packets);
    const model::config::TracedProfile& profile = candidate ? report.candidate : report.base;
    const std::string name = (candidate ? "Candidate: " : "Base: ") + profile.reference;
    chart.title = name;
    chart.closing = "Here the runs part";
    chart.sign = "≠";
    const std::string caption = fmt::format("The run of the {}, up to where the two part",
                                            candidate ? "candidate" : "base");
    const char* id = candidate ? "apart-candidate" : "apart-base";
    html += "<h3>" + html_text(name) + "</h3>\n" +
            walk_html(candidate ? apart.candidate_run : apart.base_run, chart, id, caption,
                      drawings, machines);
    const auto file = files.find(candidate ? "telling-apart.candidate" : "telling-apart.base");
    if (file != files.end()) html += paragraph_html("Written to " + file->second + ".");
  };
  add(false);
  add(true);
  return html;
}

}  // namespace stormproof::diff
