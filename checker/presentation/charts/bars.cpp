// Bars: grouped by category, and the tornado.
#include <algorithm>
#include <cmath>

#include "checker/presentation/charts/canvas.hpp"

namespace stormproof::plot {

namespace {

constexpr int bar_height = 13;

/// Room for the names at the left, at most two fifths of the width.
int name_width(const std::vector<std::string>& names, int width) {
  int widest = 0;
  for (const std::string& name : names) {
    widest = std::max(widest, draw::text_width(name, font_size));
  }
  return std::min(widest, width * 2 / 5);
}

/// `text`, shortened to fit.
std::string fitted(std::string text, int width) {
  if (draw::text_width(text, font_size) <= width) return text;
  while (!text.empty() && draw::text_width(text + "…", font_size) > width) {
    // A multi-byte character goes as a whole.
    while (text.size() > 1 && (static_cast<unsigned char>(text.back()) & 0xc0U) == 0x80U) {
      text.pop_back();
    }
    text.pop_back();
  }
  return text + "…";
}

double clamped_x(const ScaledAxis& axis, const Area& area, double value) {
  return area.x_at(std::clamp(axis.fraction(value), 0.0, 1.0));
}

}  // namespace

std::string to_svg(const BarChart& chart) {
  const int width = std::clamp(chart.width, 240, 4000);
  DataRange range{chart.value.scale};
  for (const BarChart::Group& group : chart.groups) {
    for (const double value : group.values) range.add(value);
  }
  if (chart.value.scale == Scale::linear) range.add(0);
  const int per_group = static_cast<int>(std::max<std::size_t>(chart.groups.size(), 1));
  const int row = per_group * bar_height + 12;
  draw::Svg svg{chart.title, chart.description};
  Area area;
  area.top = draw_title(svg, chart.title, width) + 8;
  area.left = 16 + name_width(chart.categories, width) + 8;
  area.width = width - area.left - 80;  // the rest is for the values at the ends of the bars
  area.height = std::max(20, static_cast<int>(chart.categories.size()) * row);
  const ScaledAxis axis{chart.value, range, area.width / 75.0};
  const int below = draw_x_axis(svg, axis, chart.value.label, area);
  const double base =
      chart.value.scale == Scale::linear ? clamped_x(axis, area, 0) : area.left * 1.0;
  std::vector<LegendEntry> legend;
  for (std::size_t g = 0; g < chart.groups.size(); ++g) {
    const bool bars = axis.scale() == Scale::linear;
    legend.push_back({chart.groups[g].name, g, bars ? Mark::line : Mark::points, bars});
    const std::size_t count = std::min(chart.categories.size(), chart.groups[g].values.size());
    for (std::size_t c = 0; c < count; ++c) {
      const double value = chart.groups[g].values[c];
      const int y = area.top + static_cast<int>(c) * row + 6 + static_cast<int>(g) * bar_height;
      if (std::isfinite(value)) {
        const double end = drawable(value, axis.scale()) ? clamped_x(axis, area, value) : base;
        if (axis.scale() == Scale::log && drawable(value, Scale::log)) {
          svg.path(mark_path({end, y + bar_height / 2.0}, g, 4), fill_class(g));
        } else {
          svg.path(rectangle_path(std::min(base, end), y, std::abs(end - base), bar_height - 2),
                   fill_class(g));
        }
        svg.text(static_cast<int>(std::max(base, end)) + 8, y + 10,
                 si_text(value, chart.value.unit), "small halo");
      }
    }
  }
  for (std::size_t c = 0; c < chart.categories.size(); ++c) {
    const int y = area.top + static_cast<int>(c) * row + row / 2 + 4;
    svg.text(area.left - 8, y, fitted(chart.categories[c], area.left - 24), "", draw::Anchor::end);
  }
  svg.line(area.left, area.top, area.left, area.bottom(), "frame");
  const int end = draw_legend(svg, legend, 12, below, width - 12);
  return svg.finish(width, end + 6, chart_style());
}

std::string to_svg(const Tornado& chart) {
  const int width = std::clamp(chart.width, 320, 4000);
  DataRange range{chart.value.scale};
  std::vector<std::string> names;
  int end_width = 0;  // of the inputs' values at the ends of the bars
  range.add(chart.base);
  for (const Tornado::Bar& bar : chart.bars) {
    range.add(bar.low);
    range.add(bar.high);
    names.push_back(bar.name);
    for (const std::string& text : {bar.low_text, bar.high_text}) {
      end_width = std::max(end_width, draw::text_width(text, 11));
    }
  }
  draw::Svg svg{chart.title, chart.description};
  const int row = bar_height + 11;
  end_width = std::min(end_width + 12, width / 5);
  Area area;
  area.top = draw_title(svg, chart.title, width) + 8;
  area.left = 16 + name_width(names, width) + 8 + end_width;
  area.width = std::max(60, width - area.left - 16 - end_width);
  area.height = std::max(20, static_cast<int>(chart.bars.size()) * row);
  const ScaledAxis axis{chart.value, range, area.width / 75.0};
  const int below = draw_x_axis(svg, axis, chart.value.label, area);
  const double base =
      drawable(chart.base, axis.scale()) ? clamped_x(axis, area, chart.base) : area.left * 1.0;
  for (std::size_t k = 0; k < chart.bars.size(); ++k) {
    const Tornado::Bar& bar = chart.bars[k];
    const int y = area.top + static_cast<int>(k) * row + 6;
    const auto one_side = [&](double value, const std::string& text, std::size_t color) {
      if (!drawable(value, axis.scale())) return;
      const double x = clamped_x(axis, area, value);
      svg.path(rectangle_path(std::min(base, x), y, std::abs(x - base), bar_height),
               fill_class(color));
      if (text.empty()) return;
      const bool left = x < base;
      svg.text(static_cast<int>(x) + (left ? -5 : 5), y + 11, text, "small halo",
               left ? draw::Anchor::end : draw::Anchor::start);
    };
    // Two ends on the same side: the longer one goes below the other.
    const bool low_is_longer = std::abs(bar.low - chart.base) > std::abs(bar.high - chart.base);
    const bool same_side = (bar.low < chart.base) == (bar.high < chart.base);
    if (low_is_longer) one_side(bar.low, bar.low_text, 0);
    one_side(bar.high, same_side && low_is_longer ? "" : bar.high_text, 1);
    if (!low_is_longer) one_side(bar.low, same_side ? "" : bar.low_text, 0);
    svg.text(16, y + 11, fitted(bar.name, area.left - end_width - 24), "");
  }
  svg.path(polyline_path({{base, area.top * 1.0}, {base, area.bottom() * 1.0}}), "frame");
  const std::vector<LegendEntry> legend{{"lower value", 0, Mark::line, true},
                                        {"higher value", 1, Mark::line, true}};
  const int end = draw_legend(svg, legend, 12, below, width - 12);
  return svg.finish(width, end + 6, chart_style());
}

}  // namespace stormproof::plot
