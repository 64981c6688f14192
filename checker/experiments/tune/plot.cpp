// Completion against messages: what the search tried, the front as a line, and what it is compared
// with.
#include "checker/presentation/charts/plot.hpp"

#include <algorithm>

#include "checker/experiments/tune/tune_report.hpp"

namespace stormproof::tune {

namespace {

constexpr double second = 1e9;

void add(plot::Series& series, const Row& row) {
  if (!row.summary.completion_ns.median) return;
  series.x.push_back(*row.summary.completion_ns.median / second);
  series.y.push_back(row.summary.messages.median.value_or(0));
}

/// Whether values span so much that only factors can be read.
plot::Scale scale_of(const std::vector<plot::Series>& all, std::vector<double> plot::Series::*of) {
  double low = 0, high = 0;
  for (const plot::Series& series : all) {
    for (const double value : series.*of) {
      if (value <= 0) continue;
      low = low == 0 ? value : std::min(low, value);
      high = std::max(high, value);
    }
  }
  return high > 5 * low ? plot::Scale::log : plot::Scale::linear;
}

plot::Series points(const char* name) {
  plot::Series series;
  series.name = name;
  series.mark = plot::Mark::points;
  return series;
}

/// A point may lie on another: their names stand beside them.
void name_points(plot::Chart& chart, const plot::Series& series) {
  for (std::size_t k = 0; k < series.x.size(); ++k) {
    chart.annotations.push_back({series.x[k], series.y[k], series.name});
  }
}

}  // namespace

std::string to_svg(const Report& report, const Context& context) {
  plot::Chart chart;
  chart.title = context.scenario + ": settings of " + context.subject.preset;
  chart.description =
      "Median completion time and median messages of discovery for every setting that was tried; "
      "the line joins those that no other setting beats in both.";
  chart.x.label = "completion";
  chart.x.unit = "s";
  chart.y.label = "messages";
  chart.width = 2 * plot::beside;

  plot::Series tried = points("tried (seeds of the search)");
  for (const Cost& cost : report.tried) {
    if (std::isinf(cost.completion)) continue;
    tried.x.push_back(cost.completion / second);
    tried.y.push_back(cost.messages);
  }
  plot::Series front = points("front");
  front.mark = plot::Mark::line_and_points;
  plot::Series unchanged = points("unchanged");
  chart.series.push_back(std::move(tried));
  std::vector<plot::Series> comparisons;
  for (std::size_t k = 0; k < report.rows.size(); ++k) {
    const Row& row = report.rows[k];
    if (row.kind == Row::Kind::front) add(front, row);
    if (row.kind == Row::Kind::unchanged) add(unchanged, row);
    if (row.kind == Row::Kind::comparison) {
      comparisons.push_back(points(row.name.c_str()));
      add(comparisons.back(), row);
    }
    if (report.recommended == k && row.kind == Row::Kind::front &&
        row.summary.completion_ns.median) {
      chart.annotations.push_back({*row.summary.completion_ns.median / second,
                                   row.summary.messages.median.value_or(0), "recommended"});
    }
  }
  chart.series.push_back(std::move(front));
  name_points(chart, unchanged);
  chart.series.push_back(std::move(unchanged));
  for (plot::Series& series : comparisons) {
    name_points(chart, series);
    chart.series.push_back(std::move(series));
  }
  chart.x.scale = scale_of(chart.series, &plot::Series::x);
  chart.y.scale = scale_of(chart.series, &plot::Series::y);
  return plot::to_svg(chart);
}

}  // namespace stormproof::tune
