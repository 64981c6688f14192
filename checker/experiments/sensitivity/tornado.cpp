// The tornado plot of the first knobs.
#include <algorithm>
#include <cmath>
#include <limits>

#include <fmt/format.h>

#include "checker/experiments/sensitivity/sensitivity_report.hpp"
#include "checker/presentation/charts/plot.hpp"

namespace stormproof::sensitivity {

namespace {

/// The axis shows the bars and a little more, not the whole way from zero: what matters is the
/// difference from the unchanged result.
void fit_axis(plot::Tornado& tornado) {
  double low = tornado.base;
  double high = tornado.base;
  for (const plot::Tornado::Bar& bar : tornado.bars) {
    for (const double end : {bar.low, bar.high}) {
      low = std::fmin(low, end);  // which pass over NaN
      high = std::fmax(high, end);
    }
  }
  if (low == high) return;
  const double margin = 0.15 * (high - low);
  tornado.value.min = std::max(0.0, low - margin);
  tornado.value.max = high + margin;
}

}  // namespace

std::string to_svg(const Report& report, const Description& description) {
  const Measure by = description.options.by;
  const double unit = by == Measure::completion ? 1e-9 : 1;  // seconds, or messages
  plot::Tornado tornado;
  tornado.title = fmt::format("{}: {} when a value changes by {:g} %", description.scenario,
                              name_of(by), 100 * description.options.range);
  tornado.description = fmt::format(
      "Tornado plot: for each knob of the scenario one bar, from the {} with its lower value to "
      "that with its higher one; the greatest effect is on top.",
      name_of(by));
  tornado.value.label = by == Measure::completion ? "time to complete discovery" : "messages";
  tornado.value.unit = by == Measure::completion ? "s" : "";
  const double base = report.base[static_cast<std::size_t>(by)] * unit;
  tornado.base = std::isfinite(base) ? base : 0;
  for (const KnobResult& knob : report.knobs) {
    if (tornado.bars.size() == description.shown || knob.is_without_effect(by)) continue;
    const auto end = [&](Direction direction) {
      const auto& level = knob.levels[static_cast<std::size_t>(direction)];
      if (!level) return std::numeric_limits<double>::quiet_NaN();
      const double value = base + of(level->effects, by).median * unit;
      return std::isfinite(value) ? value : std::numeric_limits<double>::quiet_NaN();
    };
    const auto text = [&](Direction direction) {
      const auto& level = knob.levels[static_cast<std::size_t>(direction)];
      return level ? level->value : std::string{};
    };
    tornado.bars.push_back({knob.key, end(Direction::down), end(Direction::up),
                            text(Direction::down), text(Direction::up)});
  }
  fit_axis(tornado);
  return plot::to_svg(tornado);
}

}  // namespace stormproof::sensitivity
