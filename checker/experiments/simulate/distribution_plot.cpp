// Runs in the order of their completion, the first at the bottom.
#include "checker/experiments/simulate/distribution_plot.hpp"

#include <algorithm>
#include <array>

#include <fmt/format.h>

#include "checker/presentation/charts/plot.hpp"

namespace stormproof::report {

namespace {

using exact::Health;

/// In the order of their colours: green for what is fine, orange for a storm.
constexpr std::array health_colors{
    std::pair{Health::fine, std::size_t{2}}, std::pair{Health::storm, std::size_t{1}},
    std::pair{Health::slow_link, std::size_t{0}}, std::pair{Health::waiting, std::size_t{3}},
    std::pair{Health::incomplete, std::size_t{4}}};

}  // namespace

std::string distribution_plot(const std::vector<trials::Sample>& samples,
                              model::Nanoseconds limit) {
  if (samples.size() < 2) return {};
  const auto end = [limit](const trials::Sample& one) {
    return static_cast<double>(one.discovery_time.value_or(limit).count()) * 1e-9;
  };
  std::vector<const trials::Sample*> runs;
  for (const trials::Sample& one : samples) runs.push_back(&one);
  std::ranges::stable_sort(runs, {}, [&](const trials::Sample* one) {
    return std::pair{!one->discovery_time.has_value(), end(*one)};
  });
  plot::Chart chart;
  chart.title = fmt::format("Completion of {} runs", samples.size());
  chart.description =
      "One mark for each run: when discovery was complete, and how many runs were complete by "
      "then.";
  chart.x = {.label = "completion", .unit = "s"};
  chart.y = {.label = "runs complete by then", .min = 0.0};
  chart.width = 2 * plot::beside;
  if (end(*runs.back()) > 5 * end(*runs.front())) chart.x.scale = plot::Scale::log;
  plot::Series line{.mark = plot::Mark::line, .color = 4};
  plot::Series over{.name = "not complete at the limit", .mark = plot::Mark::crosses, .color = 8};
  std::vector<plot::Series> marks;
  for (const auto& [health, color] : health_colors) {
    marks.push_back(
        {.name = exact::headline_of(health), .mark = plot::Mark::points, .color = color});
  }
  for (std::size_t k = 0; k < runs.size(); ++k) {
    const double y = static_cast<double>(k + 1);
    if (!runs[k]->discovery_time) {
      over.x.push_back(end(*runs[k]));
      over.y.push_back(y);
      continue;
    }
    line.x.push_back(end(*runs[k]));
    line.y.push_back(y);
    const auto kind = std::ranges::find(health_colors, runs[k]->health.health,
                                        [](const auto& one) { return one.first; });
    plot::Series& mark = marks[static_cast<std::size_t>(kind - health_colors.begin())];
    mark.x.push_back(end(*runs[k]));
    mark.y.push_back(y);
  }
  if (!line.x.empty()) chart.series.push_back(std::move(line));
  for (plot::Series& mark : marks) {
    if (!mark.x.empty()) chart.series.push_back(std::move(mark));
  }
  if (!over.x.empty()) chart.series.push_back(std::move(over));
  return to_svg(chart);
}

}  // namespace stormproof::report
