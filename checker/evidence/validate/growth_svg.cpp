// Small multiples: one panel for each class and one for all messages, the observation as a line,
// the model's median with its band. Each panel is a chart of its own inside the outer drawing.
#include <algorithm>

#include <fmt/format.h>

#include "checker/evidence/validate/validate.hpp"
#include "checker/presentation/charts/plot.hpp"

namespace stormproof::validate {

namespace {

constexpr double ns_per_second = 1e9;
constexpr int panel_width = 480;
constexpr int panel_height = 300;
constexpr int panel_pitch = 345;  // with the legend below the chart
constexpr int panels_across = 2;

/// Steps to show: until the observation and the slowest run of the band are over.
std::size_t steps_shown(const Report& report) {
  std::size_t last = report.observation.growth.points.size();
  for (std::size_t step = last; step < report.bands.size(); ++step) {
    const auto differs = [&](std::size_t curve) {
      return report.bands[step][curve].high != report.bands[step - 1][curve].high;
    };
    for (std::size_t curve = 0; curve < growth_curves; ++curve) {
      if (differs(curve)) last = step + 1;
    }
  }
  return last;
}

plot::Series observed(const Report& report, std::size_t curve) {
  plot::Series series{.name = "observed", .x = {0}, .y = {0}, .mark = plot::Mark::line, .color = 0};
  const Growth& growth = report.observation.growth;
  for (std::size_t step = 0; step < growth.points.size(); ++step) {
    series.x.push_back(static_cast<double>(step + 1) * static_cast<double>(growth.step_ns) /
                       ns_per_second);
    series.y.push_back(static_cast<double>(growth.points[step][curve]));
  }
  return series;
}

plot::Series modelled(const Report& report, std::size_t curve, std::size_t steps) {
  plot::Series series{.name = report.is_drawn ? "model, median and 5–95 %" : "model, one run",
                      .x = {0},
                      .y = {0},
                      .low = {0},
                      .high = {0},
                      .mark = plot::Mark::dashed_line,
                      .spread = plot::Spread::band,
                      .color = 1};
  const auto step_ns = static_cast<double>(report.observation.growth.step_ns);
  for (std::size_t step = 0; step < std::min(steps, report.bands.size()); ++step) {
    const Band& band = report.bands[step][curve];
    series.x.push_back(static_cast<double>(step + 1) * step_ns / ns_per_second);
    series.y.push_back(band.median);
    series.low.push_back(band.low);
    series.high.push_back(band.high);
  }
  return series;
}

std::string panel(const Report& report, std::size_t curve, std::size_t steps) {
  plot::Chart chart;
  const char* label = label_of(figure_of_curve(curve));
  chart.title = curve == model::message_class_count ? "All messages" : label;
  chart.description = fmt::format(
      "Cumulative number of {} over the time since the first announcement, observed and predicted",
      label);
  chart.x = {.label = "time since the first announcement", .min = 0.0, .unit = "s"};
  chart.y = {.label = "messages so far", .min = 0.0};
  chart.width = panel_width;
  chart.height = panel_height;
  chart.series.push_back(modelled(report, curve, steps));
  chart.series.push_back(observed(report, curve));
  chart.references.push_back(
      {.kind = plot::Reference::Kind::vertical,
       .value = static_cast<double>(report.observation.completion_ns()) / ns_per_second,
       .label = "cut"});
  return plot::to_svg(chart);
}

}  // namespace

std::string to_svg(const Report& report) {
  const std::size_t steps = steps_shown(report);
  std::string panels;
  int rows = 0;
  for (std::size_t curve = 0; curve < growth_curves; ++curve) {
    // All messages first.
    const std::size_t shown = (curve + growth_curves - 1) % growth_curves;
    const int column = static_cast<int>(curve) % panels_across;
    rows = static_cast<int>(curve) / panels_across + 1;
    std::string document = panel(report, shown, steps);
    const std::size_t at = document.find("<svg") + 4;
    document.insert(
        at, fmt::format(" x=\"{}\" y=\"{}\"", column * panel_width, (rows - 1) * panel_pitch));
    panels += document;
  }
  return fmt::format(
      "<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"{0}\" height=\"{1}\" "
      "viewBox=\"0 0 {0} {1}\" role=\"img\">\n"
      "  <title>Discovery messages over time, model beside observation</title>\n{2}</svg>\n",
      panels_across * panel_width, rows * panel_pitch, panels);
}

}  // namespace stormproof::validate
