// Small multiples: one panel for each class and one for all messages, the observation as a line,
// the model's median with its band. Each panel is a chart of its own on one sheet.
#include <algorithm>
#include <vector>

#include <fmt/format.h>

#include "checker/evidence/validate/validate.hpp"
#include "checker/presentation/charts/plot.hpp"
#include "checker/presentation/diagrams/svg_sheet.hpp"

namespace stormproof::validate {

namespace {

constexpr double ns_per_second = 1e9;
constexpr int panel_width = 480;
constexpr int panel_height = 300;
constexpr int panel_pitch = 345;  // with the legend below the chart
constexpr int panels_across = 2;
constexpr int head_height = 64;  // title and explanation

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

const char* words_of(Cut cut) {
  return cut == Cut::given ? "the end that was given"
                           : "the last descriptor is sent for the first time";
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
       .label = "compared so far"});
  return plot::to_svg(chart);
}

}  // namespace

std::string to_svg(const Report& report) {
  const std::size_t steps = steps_shown(report);
  std::vector<draw::PlacedDrawing> panels;
  for (std::size_t curve = 0; curve < growth_curves; ++curve) {
    // All messages first.
    const std::size_t shown = (curve + growth_curves - 1) % growth_curves;
    const int column = static_cast<int>(curve) % panels_across;
    const int row = static_cast<int>(curve) / panels_across;
    panels.push_back({draw::take_apart(panel(report, shown, steps)), column * panel_width,
                      head_height + row * panel_pitch});
  }
  const char* title = "Discovery messages over time, model beside observation";
  const std::string head = fmt::format(
      "  <text x=\"12\" y=\"26\" class=\"title\">{}</text>\n"
      "  <text x=\"12\" y=\"48\" class=\"quiet\">The upright line: {}. Messages are compared "
      "up to there.</text>\n",
      title, words_of(report.observation.cut));
  return draw::svg_sheet(title, "One panel for each class of messages", panels, head);
}

}  // namespace stormproof::validate
