// The report for reviewers: Markdown for a comment, HTML as a page with the charts.
#include <algorithm>

#include <fmt/format.h>

#include "checker/evidence/conform/report/chart.hpp"
#include "checker/evidence/conform/report/coverage.hpp"
#include "checker/evidence/conform/report/findings.hpp"
#include "checker/evidence/conform/report/names.hpp"
#include "checker/evidence/conform/report/report.hpp"
#include "checker/presentation/document/drawings.hpp"
#include "checker/presentation/document/html_page.hpp"
#include "checker/presentation/document/html_parts.hpp"
#include "checker/presentation/document/markdown.hpp"
#include "checker/presentation/text/numbers.hpp"

namespace stormproof::conform {

namespace {

using report::grouped;
using Cells = std::vector<std::vector<std::string>>;

constexpr std::size_t most_charts = 10;

/// Rules with the number of events they explain, in plain text.
Cells rule_cells(const Conformance& result) {
  Cells rows;
  for (std::size_t k = 0; k < rule_count; ++k) {
    const auto rule = static_cast<Rule>(k);
    rows.push_back(
        {std::string{name_of(rule)}, grouped(result.by_rule[k]), std::string{statement_of(rule)}});
  }
  return rows;
}

/// Machines with the rows that fired, those that could, and those that never did.
Cells machine_cells(const Report& report) {
  Cells rows;
  for (const MachineCoverage& machine : coverage_of(report.result.rows, report.dds)) {
    std::string never;
    for (const RowCoverage& row : machine.rows) {
      if (row.use->times > 0 || !row.ruled_out_by.empty()) continue;
      never += (never.empty() ? "" : "; ") + row.use->text;
    }
    rows.push_back({machine.machine, grouped(machine.used),
                    grouped(machine.rows.size() - machine.ruled_out), never});
  }
  return rows;
}

/// The places that are not explained, in plain text.
Cells fault_cells(const Report& report, const Names& names) {
  Cells rows;
  for (const FaultGroup& group : by_fault(report.result)) {
    const capture::Event& event = names.event(group.first->event);
    rows.push_back({std::string{name_of(group.fault)}, grouped(group.places),
                    names.elapsed(event.time_ns), names.packet(event),
                    names.place(group.first->place), group.first->what});
  }
  return rows;
}

template <class Escape>
Cells escaped(Cells rows, Escape escape) {
  for (auto& row : rows) {
    for (std::string& cell : row) cell = escape(cell);
  }
  return rows;
}

std::string figures_text(const Conformance& result) {
  return fmt::format(
      "{} events checked, {} explained, {} not checked; {} datagrams taken as lost; longest send "
      "lag {}, latest timer {}.",
      grouped(result.checked), grouped(result.explained), grouped(result.not_checked),
      grouped(result.lost), milliseconds(result.used_send_lag_ns),
      milliseconds(result.used_lateness_ns));
}

report::Tone tone_of(Verdict verdict) {
  switch (verdict) {
    case Verdict::conforms:
      return report::Tone::good;
    case Verdict::does_not_conform:
      return report::Tone::bad;
    case Verdict::inconclusive:
      break;
  }
  return report::Tone::warn;
}

std::string table_html(std::vector<std::string> head, std::string align, const Cells& plain) {
  report::parts::HtmlTable table;
  table.head = std::move(head);
  table.align = std::move(align);
  table.rows = escaped(plain, [](const std::string& cell) { return report::html_text(cell); });
  return to_html(table);
}

std::string charts_html(const Report& report, const Names& names, report::Drawings& drawings) {
  std::string html;
  const auto& unexplained = report.result.unexplained;
  for (std::size_t k = 0; k < std::min(unexplained.size(), most_charts); ++k) {
    const Unexplained& one = unexplained[k];
    const std::string svg =
        drawings.add(svg_chart(chart_of(report, one)), fmt::format("chart-{}", k));
    html += report::parts::drawing_html(svg, names.place(one.place) + ": " + one.what);
    html += report::parts::preformatted(names.tshark(names.event(one.event)));
  }
  if (unexplained.size() > most_charts) {
    html += report::parts::paragraph_html(
        fmt::format("{} more places are in the JSON report.", unexplained.size() - most_charts));
  }
  return html;
}

}  // namespace

std::string to_markdown(const Report& report) {
  using report::md_text;
  const Names names{report.conversation};
  report::MarkdownDocument document;
  document.add("", "**" + md_text(verdict_line(report)) + "**\n\n" +
                       md_text(verdict_meaning(report)) + "\n\n" +
                       md_text(captures_text(report) + ": " + figures_text(report.result)) + "\n");
  if (!report.result.unexplained.empty()) {
    document.add("the faults",
                 "\n" + report::md_table({"fault", "places", "first", "packet", "where", "what"},
                                         "lrrlll", escaped(fault_cells(report, names), md_text)));
    const sequence::Chart chart = chart_of(report, report.result.unexplained.front());
    document.add("the chart", "\n" + md_text(chart.header.back()) +
                                  "\n\nNearest assignment: " + md_text(chart.reason) + "\n\n" +
                                  report::md_block("text", text_chart(chart)));
  }
  document.add("the rules",
               "\n" + report::md_details(
                          "Rules", report::md_table({"rule", "events", "when it sends"}, "lrl",
                                                    escaped(rule_cells(report.result), md_text))));
  document.add(
      "the machines",
      "\n" + report::md_details("Rows of the machines",
                                report::md_table({"machine", "fired", "possible", "never fired"},
                                                 "lrrl", escaped(machine_cells(report), md_text))));
  std::string notes;
  for (const std::string& one : report.result.assumptions) notes += "- " + md_text(one) + "\n";
  if (!notes.empty()) document.add("the assumptions", "\nAssumptions\n\n" + notes);
  return document.text("the JSON report");
}

std::string to_html(const Report& report) {
  const Names names{report.conversation};
  report::Drawings drawings;
  std::string body =
      report::parts::banner(tone_of(report.result.verdict), verdict_line(report),
                            report::parts::paragraph_html(verdict_meaning(report)) +
                                report::parts::paragraph_html(captures_text(report) + ": " +
                                                              figures_text(report.result)));
  if (!report.result.unexplained.empty()) {
    body += report::parts::heading("What no assignment explains", "unexplained");
    body += table_html({"fault", "places", "first", "packet", "where", "what"}, "trrtll",
                       fault_cells(report, names));
    body += charts_html(report, names, drawings);
  }
  body +=
      report::parts::heading("Rules", "rules") +
      table_html({"rule", "events", "when it sends"}, "trl", rule_cells(report.result)) +
      report::parts::heading("Rows of the machines", "machines") +
      table_html({"machine", "fired", "possible", "never fired"}, "trrl", machine_cells(report));
  const auto& notes = report.result.assumptions;
  if (!notes.empty())
    body += report::parts::heading("Assumptions", "assumptions") + report::parts::bullets(notes);
  return report::html_page("conform: " + captures_text(report), body, drawings);
}

}  // namespace stormproof::conform
