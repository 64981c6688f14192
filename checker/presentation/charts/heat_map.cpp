// A surface seen from above. Colours come in ten steps, from quiet to strong on either paper; the
// value is written into its cell where there is room.
#include <algorithm>
#include <array>
#include <cmath>

#include <fmt/format.h>

#include "checker/presentation/charts/canvas.hpp"

namespace stormproof::plot {

namespace {

constexpr int steps = 10;
using Rgb = std::array<int, 3>;

std::string mixed(const Rgb& from, const Rgb& to, int step) {
  Rgb color{};
  for (std::size_t k = 0; k < color.size(); ++k) {
    color[k] = from[k] + (to[k] - from[k]) * step / (steps - 1);
  }
  return fmt::format("#{:02x}{:02x}{:02x}", color[0], color[1], color[2]);
}

std::string heat_style() {
  std::string light;
  std::string dark;
  std::string rules;
  for (int k = 0; k < steps; ++k) {
    light += fmt::format("--h{}: {}; ", k, mixed({0xec, 0xf2, 0xfb}, {0x0c, 0x3c, 0x86}, k));
    dark += fmt::format("--h{}: {}; ", k, mixed({0x1c, 0x27, 0x33}, {0xa8, 0xce, 0xff}, k));
    rules += fmt::format("    .h{0} {{ fill: var(--h{0}); }}\n", k);
  }
  return fmt::format(
      "    svg {{ {} }}\n    @media (prefers-color-scheme: dark) {{ svg {{ {} }} }}\n{}"
      "    .on-strong {{ fill: var(--paper); }}\n",
      light, dark, rules);
}

int step_of(const ScaledAxis& colors, double value) {
  return std::clamp(static_cast<int>(colors.fraction(value) * steps), 0, steps - 1);
}

void draw_cells(draw::Svg& svg, const HeatMap& chart, const ScaledAxis& colors, const Area& area,
                int cell_width, int cell_height) {
  for (std::size_t r = 0; r < std::min(chart.y.size(), chart.value.size()); ++r) {
    const int y = area.bottom() - static_cast<int>(r + 1) * cell_height;
    for (std::size_t c = 0; c < std::min(chart.x.size(), chart.value[r].size()); ++c) {
      const double value = chart.value[r][c];
      const int x = area.left + static_cast<int>(c) * cell_width;
      if (!drawable(value, colors.scale())) continue;
      const int step = step_of(colors, value);
      svg.rect(x, y, cell_width - 1, cell_height - 1, fmt::format("h{}", step));
      const std::string text = si_text(value, chart.unit);
      if (draw::text_width(text, 11) > cell_width - 2) continue;
      svg.text(x + cell_width / 2, y + cell_height / 2 + 4, text,
               step >= steps / 2 ? "small on-strong" : "small", draw::Anchor::middle);
    }
  }
}

/// The scale of the colours, from `x` to the right.
void draw_colors(draw::Svg& svg, const HeatMap& chart, const ScaledAxis& colors, int x, int y) {
  constexpr int step_width = 26;
  for (int k = 0; k < steps; ++k) {
    svg.rect(x + k * step_width, y, step_width, 12, fmt::format("h{}", k));
  }
  const std::string low = si_text(colors.low(), chart.unit);
  const std::string high = si_text(colors.high(), chart.unit);
  svg.text(x, y + 28, low, "");
  svg.text(x + steps * step_width, y + 28, high, "", draw::Anchor::end);
  svg.text(x + steps * step_width + 12, y + 11, chart.value_label, "quiet");
}

}  // namespace

std::string to_svg(const HeatMap& chart) {
  const int width = std::clamp(chart.width, 240, 4000);
  DataRange range{chart.scale};
  for (const std::vector<double>& row : chart.value) {
    for (const double value : row) range.add(value);
  }
  const ScaledAxis colors{Axis{"", chart.scale, chart.min, chart.max, chart.unit, {}}, range, 6};
  draw::Svg svg{chart.title, chart.description};
  int names = 0;
  for (const std::string& name : chart.y) {
    names = std::max(names, draw::text_width(name, font_size));
  }
  Area area;
  area.top = draw_title(svg, chart.title, width) + 26;
  area.left = 16 + names + 8;
  const int columns = static_cast<int>(std::max<std::size_t>(chart.x.size(), 1));
  const int rows = static_cast<int>(std::max<std::size_t>(chart.y.size(), 1));
  const int cell_width = std::max(2, (width - area.left - 16) / columns);
  const int cell_height = std::clamp(cell_width, 14, 30);
  area.width = cell_width * columns;
  area.height = cell_height * rows;
  svg.text(12, area.top - 10, chart.y_label, "quiet");
  draw_cells(svg, chart, colors, area, cell_width, cell_height);
  for (std::size_t r = 0; r < chart.y.size(); ++r) {
    const int y = area.bottom() - static_cast<int>(r) * cell_height - cell_height / 2 + 4;
    svg.text(area.left - 8, y, chart.y[r], "", draw::Anchor::end);
  }
  int free_from = 0;
  for (std::size_t c = 0; c < chart.x.size(); ++c) {
    const int x = area.left + static_cast<int>(c) * cell_width + cell_width / 2;
    const int half = (draw::text_width(chart.x[c], font_size) + 1) / 2;
    if (x - half < free_from) continue;
    svg.text(x, area.bottom() + 16, chart.x[c], "", draw::Anchor::middle);
    free_from = x + half + 6;
  }
  svg.text(area.left + area.width / 2, area.bottom() + 34, chart.x_label, "quiet",
           draw::Anchor::middle);
  draw_colors(svg, chart, colors, area.left, area.bottom() + 48);
  return svg.finish(width, area.bottom() + 88, chart_style() + heat_style());
}

}  // namespace stormproof::plot
