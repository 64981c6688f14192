// Which plan is soonest, what the deployed one is like, and the hump between.
#include <algorithm>
#include <limits>

#include <fmt/core.h>

#include "checker/experiments/launch/launch_report.hpp"
#include "checker/experiments/trials/tone_of_health.hpp"
#include "checker/experiments/trials/usual_hosts.hpp"
#include "checker/presentation/charts/plot.hpp"
#include "checker/presentation/document/unmodelled.hpp"
#include "checker/presentation/text/command_line.hpp"
#include "checker/presentation/text/figures.hpp"
#include "checker/presentation/text/numbers.hpp"
#include "checker/presentation/text/plain_text.hpp"
#include "checker/verification/check/next_steps.hpp"

namespace stormproof::launch {

namespace {

using report::Column;
using report::Paragraph;
using report::Table;
using report::Tone;

constexpr const char* beyond = "> limit";

std::string median_text(const Cell& cell) {
  return report::time_figure(cell.completion.median, beyond);
}

std::string range_text(const Cell& cell) {
  const statistics::Quantiles& q = cell.completion;
  if (q.count < 2 || !q.min) return median_text(cell);
  return fmt::format("{} [{} – {}]", median_text(cell), report::time_figure(q.min, beyond),
                     report::time_figure(q.max, beyond));
}

std::string storms_text(const Cell& cell) {
  std::string text = cell.storms == 0
                         ? "no storm"
                         : fmt::format("STORM in {} of {} runs", cell.storms, cell.runs.size());
  if (cell.incomplete == 0) return text;
  return text + fmt::format(", not complete in {} of {}", cell.incomplete, cell.runs.size());
}

/// The spread that takes longest beside what the spread itself takes, with the first setting, if
/// that is more than all at once takes.
const Row* worst_spread(const Report& report) {
  const auto excess = [](const Row& row) {
    const auto last = static_cast<double>(row.last_start.value_or(model::Nanoseconds{}).count());
    return row.cells.front().completion.median.value_or(statistics::unreached) - last;
  };
  const Row* worst = nullptr;
  double most = 0;
  for (const Row& row : report.rows) {
    if (row.plan.order == Order::at_once) most = std::max(most, excess(row));
  }
  for (const Row& row : report.rows) {
    if (row.cells.front().runs.empty() || row.plan.step.count() == 0) continue;
    if (excess(row) <= most) continue;
    worst = &row;
    most = excess(row);
  }
  return worst;
}

bool has_storms(const Report& report) {
  return std::ranges::any_of(report.rows, [](const Row& row) {
    return std::ranges::any_of(row.cells, [](const Cell& cell) { return cell.storms > 0; });
  });
}

/// "process by process, 100ms apart: after 14.68 s, STORM in 5 of 5 runs".
std::string deployed_text(const Report& report) {
  const Row& now = report.rows.front();
  if (now.cells.front().runs.empty()) return words_of(now.plan);
  return fmt::format("{}: after {}, {}", words_of(now.plan), median_text(now.cells.front()),
                     storms_text(now.cells.front()));
}

void add_head(report::Document& document, const Report& report, const Request& request) {
  document.title = "stormproof launch " + request.scenario;
  document.complete = !report.interrupted;
  document.exit_code = report.interrupted ? 3 : 0;
  document.subject = fmt::format("{}: {}, {} of each", request.scenario,
                                 report::plural(report.rows.size(), "launch plan"),
                                 report::plural(request.samples, "run"));
  const auto best = report.best();
  document.tone = report.interrupted || !best ? Tone::warn : Tone::info;
  if (!best) {
    document.answer = fmt::format("Under no plan all runs are complete within {}. Deployed is {}.",
                                  report::duration(request.limit), deployed_text(report));
    return;
  }
  const Row& row = report.rows[best->row];
  const std::string setting =
      best->setting == 0 ? "" : " and " + report.settings[best->setting].name;
  const std::string when = median_text(row.cells[best->setting]);
  document.answer =
      best->row == 0 && best->setting == 0
          ? fmt::format(
                "As deployed, {}, everybody knows everybody soonest: after {} at the "
                "median, {}.",
                words_of(row.plan), when, storms_text(row.cells[0]))
          : fmt::format(
                "Everybody knows everybody soonest with {}{}: after {} at the median. Deployed is "
                "{}.",
                words_of(row.plan), setting, when, deployed_text(report));
  if (const Row* worst = worst_spread(report)) {
    const auto& median = worst->cells.front().completion.median;
    document.elaboration = fmt::format(
        "Spreading the starts can make it worse: {} {} at the median, and the spread itself is {}.",
        words_of(worst->plan),
        median ? "takes " + report::time_figure(*median) : std::string{"is not complete in time"},
        report::duration(worst->last_start.value_or(model::Nanoseconds{})));
  }
}

Table table_of(const Report& report, const Request& request) {
  Table table{{{"plan"}, {"last start", Column::Align::right}}, {}};
  for (const Setting& setting : report.settings) {
    table.columns.push_back({setting.name + " [range]", Column::Align::right});
    table.columns.push_back({"messages", Column::Align::right});
    table.columns.push_back({"storms", Column::Align::right});
  }
  table.wide = true;
  table.caption = fmt::format("from the first start until everybody knows everybody; limit {}",
                              report::duration(request.limit));
  for (std::size_t k = 0; k < report.rows.size(); ++k) {
    const Row& row = report.rows[k];
    Table::Row line{{(k == 0 ? "→ " : "") + words_of(row.plan),
                     row.last_start ? report::duration(*row.last_start) : "–"},
                    k == 0};
    for (const Cell& cell : row.cells) {
      line.cells.emplace_back(cell.runs.empty() ? "–" : range_text(cell));
      line.cells.emplace_back(report::count_figure(cell.messages.median));
      line.cells.emplace_back(fmt::format("{}/{}", cell.storms, cell.runs.size()));
    }
    table.rows.push_back(std::move(line));
  }
  return table;
}

/// What is proved of all plans, or how often the best plan of a setting storms.
void add_proofs(report::Blocks& blocks, const Report& report) {
  for (std::size_t s = 0; s < report.settings.size(); ++s) {
    const Setting& setting = report.settings[s];
    const auto best = report.best(s);
    if (setting.proved.value_or(false)) {
      blocks.emplace_back(Paragraph{fmt::format(
          "{}: storm.cannot-start is proved for all start times of programs that take no time, so "
          "all at once is the shortest plan that is proved free of storms.",
          setting.name)});
      continue;
    }
    std::string text = setting.name + ": no plan is proved free of storms";
    if (!setting.proved) text += " (storm.cannot-start is not about it)";
    if (best) {
      const Cell& cell = report.rows[best->row].cells[s];
      text += fmt::format("; soonest is {}: {} of {} sampled runs are storms",
                          words_of(report.rows[best->row].plan), cell.storms, cell.runs.size());
    }
    blocks.emplace_back(Paragraph{text + "."});
  }
}

void add_joins(report::Blocks& blocks, const Report& report) {
  if (report.joins.empty()) return;
  Table table{{{"one robot more"},
               {"until everybody knows it [range]", Column::Align::right},
               {"messages", Column::Align::right},
               {"between the others", Column::Align::right}},
              {}};
  table.caption =
      "a robot joins 10 s after the others are complete: medians; messages and datagrams more than "
      "without it";
  for (std::size_t s = 0; s < report.joins.size(); ++s) {
    const Join& join = report.joins[s];
    const auto number = [](const std::optional<double>& value) {
      return value ? fmt::format("{:.0f}", *value) : std::string{"–"};
    };
    table.rows.push_back(
        {{report.settings[s].name,
          fmt::format("{} [{} – {}]", report::time_figure(join.took.median, beyond),
                      report::time_figure(join.took.min, beyond),
                      report::time_figure(join.took.max, beyond)),
          number(join.messages.median), number(join.others.median)}});
  }
  blocks.emplace_back(std::move(table));
}

void add_assumptions(report::Document& document, const Report& report, const Request& request) {
  document.assumptions.emplace_back(fmt::format(
      "Each process starts up to {} later than planned, and takes as long to create its endpoints "
      "as the scenario says, under every plan.",
      report::duration(request.start_jitter)));
  if (report.usual_hosts) {
    document.assumptions.emplace_back(fmt::format(
        "The scenario says no hosts, so programs take the processor time that was measured "
        "(hosts: {}); --set hosts=… says otherwise.",
        trials::usual_hosts));
  }
  document.assumptions.emplace_back(
      "A plan that waits starts the next at the instant at which those before know each other.");
  report::add_unmodelled(document, report.settings.front().scenario.dds);
}

}  // namespace

report::Document document_of(const Report& report, const Request& request,
                             const std::vector<std::string>& written) {
  report::Document document;
  add_head(document, report, request);
  document.blocks.emplace_back(table_of(report, request));
  document.blocks.emplace_back(report::Drawing{to_svg(report), ""}, report::Audience::page);
  add_proofs(document.blocks, report);
  add_joins(document.blocks, report);
  report::add_definition(document.blocks, has_storms(report),
                         report.settings.front().scenario.limits);
  const std::string words = checker::words_of(request.scenario, request.overrides);
  if (!written.empty()) {
    document.blocks.emplace_back(
        Paragraph{fmt::format("{} to start that way, from {} on",
                              report::plural(written.size(), "file"), written.front())});
  } else {
    document.next.push_back({report::program() + " launch " + words + " --export launch",
                             "what a robot runs to start as the soonest plan says"});
  }
  if (report.joins.empty()) {
    document.next.push_back({report::program() + " launch " + words + " --join",
                             "what one more robot costs the running fleet"});
  }
  add_assumptions(document, report, request);
  return document;
}

std::string to_svg(const Report& report) {
  constexpr double no_value = std::numeric_limits<double>::quiet_NaN();
  plot::Chart chart;
  chart.title = "Completion over the spread of starts";
  chart.description =
      "From the first start until everybody knows everybody: median and range of the runs, for "
      "each distance between starts; all at once at the left.";
  chart.x = {"between two starts", plot::Scale::log, {}, {}, "s", {}};
  chart.y = {"completion", plot::Scale::log, {}, {}, "s", {}};
  const auto seconds = [](const std::optional<double>& ns) { return ns ? *ns * 1e-9 : no_value; };
  for (const Order order : {Order::by_process, Order::by_host}) {
    for (std::size_t s = 0; s < report.settings.size(); ++s) {
      plot::Series series;
      series.name = fmt::format("{}, {}", order == Order::by_process ? "by process" : "by host",
                                report.settings[s].name);
      std::vector<const Row*> rows;
      for (const Row& row : report.rows) {
        if (row.plan.order == order || row.plan.order == Order::at_once) rows.push_back(&row);
      }
      std::ranges::sort(rows, {}, [](const Row* row) { return row->plan.step; });
      for (const Row* row : rows) {
        const statistics::Quantiles& q = row->cells[s].completion;
        series.x.push_back(std::max(1e-3, static_cast<double>(row->plan.step.count()) * 1e-9));
        series.y.push_back(seconds(q.median));
        series.low.push_back(seconds(q.min));
        series.high.push_back(seconds(q.max));
      }
      if (series.x.size() > 1) chart.series.push_back(std::move(series));
    }
  }
  return plot::to_svg(chart);
}

}  // namespace stormproof::launch
