// One line for each candidate that has runs.
#include <cmath>
#include <limits>

#include <fmt/core.h>

#include "checker/experiments/compare/compare_report.hpp"
#include "checker/presentation/charts/plot.hpp"

namespace stormproof::compare {

namespace {

constexpr double no_value = std::numeric_limits<double>::quiet_NaN();

double shown(Figure figure, const std::optional<double>& value) {
  if (!value) return no_value;
  return figure == Figure::completion ? *value * 1e-9 : *value;
}

}  // namespace

std::string growth_plot(const Report& report, Figure figure) {
  plot::Chart chart;
  chart.title = fmt::format("{} over {}", words_of(figure), words_of(report.grows));
  chart.description = fmt::format(
      "{}: median and range of the runs for each way to discover, up to the size at which it "
      "breaks "
      "(✗); what is not complete stands at the limit.",
      words_of(figure));
  chart.x.label = words_of(report.grows);
  for (const std::uint32_t size : report.sizes) chart.x.ticks.push_back(size);
  const double room = 0.04 * (report.sizes.back() - report.sizes.front());
  chart.x.min = report.sizes.front() - room;
  chart.x.max = report.sizes.back() + room;
  chart.y.label = words_of(figure);
  chart.y.scale = plot::Scale::log;
  if (figure == Figure::completion) chart.y.unit = "s";
  std::vector<plot::Series> ends;
  for (const Row& row : report.rows) {
    plot::Series series;
    plot::Series end;
    series.name = row.candidate.name;
    series.color = end.color = chart.series.size();
    end.mark = plot::Mark::crosses;
    for (const Cell& cell : row.cells) {
      if (cell.runs.empty()) continue;
      const statistics::Quantiles& values = cell.figures[static_cast<std::size_t>(figure)];
      const bool is_over = figure == Figure::completion && !values.median;
      const double y =
          is_over ? static_cast<double>(report.limit.count()) * 1e-9 : shown(figure, values.median);
      series.x.push_back(cell.size);
      series.y.push_back(y);
      series.low.push_back(shown(figure, values.min));
      series.high.push_back(shown(figure, values.max));
      if (!is_over && !cell.breaks) continue;
      end.x.push_back(cell.size);
      end.y.push_back(y);
    }
    if (!series.x.empty()) chart.series.push_back(std::move(series));
    if (!end.x.empty()) ends.push_back(std::move(end));
  }
  for (plot::Series& end : ends) chart.series.push_back(std::move(end));
  return to_svg(chart);
}

std::string classes_plot(const Report& report) {
  plot::BarChart chart;
  chart.title = fmt::format("Messages by class at {} {}", report.own_size, words_of(report.grows));
  chart.description = "Median number of messages of each class, for each way to discover.";
  chart.value = {.label = "messages (median)", .min = 0.0};
  chart.width = 2 * plot::beside;
  for (const Figure figure : {Figure::initial_data, Figure::repair_data, Figure::heartbeat,
                              Figure::acknack, Figure::announcements}) {
    chart.groups.push_back({words_of(figure), {}});
    for (const Row& row : report.rows) {
      const Cell& cell = row.cells[report.own_index()];
      if (cell.runs.empty()) continue;
      const auto& median = cell.figures[static_cast<std::size_t>(figure)].median;
      chart.groups.back().values.push_back(median.value_or(no_value));
    }
  }
  for (const Row& row : report.rows) {
    if (!row.cells[report.own_index()].runs.empty()) chart.categories.push_back(row.candidate.name);
  }
  return chart.categories.empty() ? std::string{} : to_svg(chart);
}

}  // namespace stormproof::compare
