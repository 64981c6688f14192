// What a comparison measured, as HTML.
#include <fmt/format.h>

#include "checker/experiments/diff/diff_html_parts.hpp"
#include "checker/experiments/diff/diff_plots.hpp"
#include "checker/experiments/diff/judging.hpp"
#include "checker/experiments/diff/words.hpp"
#include "checker/presentation/document/html_page.hpp"
#include "checker/presentation/text/numbers.hpp"

namespace stormproof::diff {

namespace {

using report::Drawings;
using report::html_text;
using report::parts::code;
using report::parts::heading;
using report::parts::HtmlTable;
using report::parts::paragraph_html;

std::string cost_cell(const MeasuredChange& change) {
  return fmt::format("{} → {}<br><span class=\"soft\">{}</span>",
                     html_text(value_text(change.measure, change.before.median)),
                     html_text(value_text(change.measure, change.after.median)),
                     html_text(change_text(change)));
}

std::string costs_table(const DiffReport& report) {
  const CostComparison& costs = report.costs;
  HtmlTable table;
  table.caption = fmt::format(
      "Medians with the base → with the candidate; below, the shift with its confidence interval "
      "({} each). Seed {}.",
      share_text(costs.confidence), costs.seed);
  table.head = {"configuration", "judgment",        "runs",  "completion", "messages",
                "repairs",       "highest backlog", "storms"};
  table.align = "ltrtttt";
  for (const Configuration& one : costs.configurations) {
    const std::string storms =
        fmt::format("{} → {}", one.storm_before ? "yes" : "no", one.storm_after ? "yes" : "no");
    table.rows.push_back({html_text(one.name), judgment_badge(judgment_of(one, report.policy)),
                          one.identical_runs ? "the same runs" : report::grouped(one.samples),
                          cost_cell(one[Measure::completion]), cost_cell(one[Measure::messages]),
                          cost_cell(one[Measure::repair_data]), cost_cell(one[Measure::backlog]),
                          storms});
  }
  return to_html(table);
}

std::string crossings_html(const CostComparison& costs) {
  HtmlTable table;
  table.caption = "Limits, and the share of runs that exceed them.";
  table.head = {"limit", "configuration", "base", "candidate", "judgment"};
  table.align = "tlrrt";
  for (const Configuration& one : costs.configurations) {
    for (const LimitCrossing& crossing : one.crossings) {
      table.rows.push_back({code(crossing.text), html_text(one.name), share_text(crossing.before),
                            share_text(crossing.after), judgment_badge(crossing.judgment)});
    }
  }
  return table.rows.empty() ? std::string{} : to_html(table);
}

std::string pooled_html(const CostComparison& costs) {
  std::vector<std::string> lines;
  for (const PooledChange& change : costs.pooled) {
    lines.push_back(
        fmt::format("{}, all {} open configurations together ({}): {} ({} … {} at {}), {}",
                    words_of(change.measure), change.configurations, plural(change.pairs, "pair"),
                    change_text(change.estimate), change_text(change.low), change_text(change.high),
                    share_text(change.confidence), name_of(change.judgment)));
  }
  return report::parts::bullets(lines);
}

}  // namespace

std::string costs_html(const DiffReport& report, Drawings& drawings) {
  const CostComparison& costs = report.costs;
  std::string html = heading("Completion, messages, backlog", "costs");
  if (costs.configurations.empty()) return html + paragraph_html("No configuration was run.");
  html += paragraph_html(fmt::format("Over the grid {}: {} of {} configurations.", costs.grid,
                                     costs.configurations.size(), costs.wanted));
  html += "<div class=\"plots\">\n";
  for (const std::string& svg : measure_plots(costs, Measure::completion)) {
    html += drawings.add(svg);
  }
  html += "</div>\n<div class=\"plots\">\n";
  for (const Configuration* one : notable(costs)) html += drawings.add(classes_plot(*one));
  html += drawings.add(measure_plots(costs, Measure::messages).front()) +
          drawings.add(measure_plots(costs, Measure::backlog).front()) + "</div>\n";
  return html + pooled_html(costs) + crossings_html(costs) + costs_table(report);
}

}  // namespace stormproof::diff
