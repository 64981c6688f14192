// Frame, legend and style sheet of charts.
#include "checker/presentation/charts/canvas.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include <fmt/format.h>

namespace stormproof::plot {

namespace {

// One colour of each pair for light paper, one for dark; neighbours differ in lightness, too.
constexpr std::array<std::array<const char*, 2>, color_count> colors{{{"#1f5fbf", "#7fb0ff"},
                                                                      {"#c2570c", "#ffa45c"},
                                                                      {"#1b7f4d", "#6fd19c"},
                                                                      {"#9c2f80", "#f08cd0"},
                                                                      {"#5c6773", "#a9b4bf"},
                                                                      {"#007a8a", "#5fd0e0"},
                                                                      {"#786800", "#d9c64a"},
                                                                      {"#6a3fb5", "#b79cf5"},
                                                                      {"#c0242c", "#ff8a8a"},
                                                                      {"#4f7300", "#a9d45a"},
                                                                      {"#7a4a2b", "#d3a27f"},
                                                                      {"#0b2f5c", "#c9dcf2"}}};

constexpr std::string_view classes = R"(
    .chart-title { font-size: 14px; font-weight: 600; }
    .grid { stroke: var(--rule); stroke-width: 1; opacity: .55; }
    .frame { stroke: var(--quiet); stroke-width: 1; fill: none; }
    .reference { stroke: var(--quiet); stroke-width: 1; stroke-dasharray: 2 3; fill: none; }
    .curve { stroke-width: 1.8; fill: none; stroke-linejoin: round; }
    .dashed { stroke-dasharray: 7 4; }
    .whisker { stroke-width: 1.2; fill: none; opacity: .75; }
    .band { opacity: .18; }
    .many { opacity: .55; }
    .halo { paint-order: stroke; stroke: var(--paper); stroke-width: 4px; stroke-linejoin: round; }
    .light-end { opacity: .55; }
)";

}  // namespace

std::string palette_style() {
  std::string light;
  std::string dark;
  std::string rules;
  for (std::size_t k = 0; k < color_count; ++k) {
    light += fmt::format("--c{}: {}; ", k, colors[k][0]);
    dark += fmt::format("--c{}: {}; ", k, colors[k][1]);
    rules += fmt::format(
        "    .s{0} {{ stroke: var(--c{0}); }}\n    .f{0} {{ fill: var(--c{0}); }}\n", k);
  }
  return fmt::format(
      "    svg {{ {} }}\n    @media (prefers-color-scheme: dark) {{ svg {{ {} }} }}\n{}", light,
      dark, rules);
}

std::string chart_style() { return palette_style() + std::string{classes}; }

std::string stroke_class(std::size_t color) { return fmt::format("s{}", color % color_count); }
std::string fill_class(std::size_t color) { return fmt::format("f{}", color % color_count); }

std::string mark_path(Pixel at, std::size_t color, double radius) {
  const auto [x, y] = at;
  const double r = radius;
  switch (color % 6) {
    case 0:
      return fmt::format("M{:.1f} {:.1f}a{r} {r} 0 1 0 {d} 0a{r} {r} 0 1 0 -{d} 0z", x - r, y,
                         fmt::arg("r", r), fmt::arg("d", 2 * r));
    case 1:
      return rectangle_path(x - r * 0.9, y - r * 0.9, r * 1.8, r * 1.8);
    case 2:
      return fmt::format("M{:.1f} {:.1f}l{r} {r}l-{r} {r}l-{r} -{r}z", x, y - r * 1.2,
                         fmt::arg("r", r * 1.2));
    case 3:
      return fmt::format("M{:.1f} {:.1f}l{} {}h-{}z", x, y - r * 1.1, r * 1.15, r * 2, r * 2.3);
    case 4:
      return fmt::format("M{:.1f} {:.1f}l-{} -{}h{}z", x, y + r * 1.1, r * 1.15, r * 2, r * 2.3);
    default: {
      const double a = r * 0.45;  // half the width of an arm
      const double b = r * 1.15;
      return fmt::format("M{:.1f} {:.1f}h{}v{}h{}v{}h-{}v{}h-{}v-{}h-{}v-{}h{}z", x - a, y - b,
                         2 * a, b - a, b - a, 2 * a, b - a, b - a, 2 * a, b - a, b - a, 2 * a,
                         b - a);
    }
  }
}

std::string polyline_path(const std::vector<Pixel>& points) {
  std::string path;
  for (const Pixel& p : points) {
    path += fmt::format("{}{:.1f} {:.1f}", path.empty() ? 'M' : 'L', p.x, p.y);
  }
  return path;
}

std::string rectangle_path(double x, double y, double width, double height) {
  return fmt::format("M{:.1f} {:.1f}h{:.1f}v{:.1f}h{:.1f}z", x, y, width, height, -width);
}

int draw_title(draw::Svg& svg, const std::string& title, int width) {
  if (title.empty()) return 8;
  // A title that does not fit continues on further lines.
  int y = 6;
  std::string line;
  std::string rest = title + ' ';
  for (std::size_t end = rest.find(' '); end != std::string::npos; end = rest.find(' ')) {
    const std::string word = rest.substr(0, end);
    rest.erase(0, end + 1);
    const std::string longer = line.empty() ? word : line + ' ' + word;
    if (!line.empty() && draw::text_width(longer, 14) > width - 24) {
      svg.text(12, y += 19, line, "chart-title");
      line = word;
    } else {
      line = longer;
    }
  }
  svg.text(12, y += 19, line, "chart-title");
  return y + 10;
}

int draw_x_axis(draw::Svg& svg, const ScaledAxis& axis, const std::string& label,
                const Area& area) {
  int free_from = 0;
  for (const Tick& tick : axis.ticks()) {
    const int x = static_cast<int>(std::lround(area.x_at(axis.fraction(tick.value))));
    svg.line(x, area.top, x, area.bottom(), "grid");
    svg.line(x, area.bottom(), x, area.bottom() + 4, "frame");
    const int half = (draw::text_width(tick.text, font_size) + 1) / 2;
    if (x - half < free_from) continue;
    svg.text(x, area.bottom() + 18, tick.text, "", draw::Anchor::middle);
    free_from = x + half + 8;
  }
  int y = area.bottom() + 22;
  if (!label.empty()) {
    y += line_height;
    svg.text(area.left + area.width / 2, y, label, "quiet", draw::Anchor::middle);
  }
  return y + 8;
}

void draw_y_axis(draw::Svg& svg, const ScaledAxis& axis, const std::string& label,
                 const Area& area) {
  int free_to = area.bottom() + line_height;
  for (const Tick& tick : axis.ticks()) {
    const int y = static_cast<int>(std::lround(area.y_at(axis.fraction(tick.value))));
    svg.line(area.left, y, area.right(), y, "grid");
    svg.line(area.left - 4, y, area.left, y, "frame");
    if (y + line_height / 2 > free_to) continue;
    svg.text(area.left - 8, y + 4, tick.text, "", draw::Anchor::end);
    free_to = y - line_height / 2;
  }
  if (!label.empty()) svg.text(12, area.top - 12, label, "quiet");
}

int label_width(const ScaledAxis& axis) {
  int width = 0;
  for (const Tick& tick : axis.ticks()) {
    width = std::max(width, draw::text_width(tick.text, font_size));
  }
  return width;
}

int draw_legend(draw::Svg& svg, const std::vector<LegendEntry>& entries, int left, int y,
                int width) {
  if (entries.empty()) return y;
  int x = left;
  int baseline = y + 14;
  for (const LegendEntry& entry : entries) {
    const int needed = 32 + draw::text_width(entry.name, font_size) + 20;
    if (x > left && x + needed > width) {
      x = left;
      baseline += line_height + 4;
    }
    const int middle = baseline - 4;
    const Pixel center{x + 12.0, static_cast<double>(middle)};
    if (entry.block) {
      svg.rect(x, middle - 5, 24, 10, fill_class(entry.color));
    } else if (entry.reference) {
      svg.path(polyline_path({{x * 1.0, center.y}, {x + 24.0, center.y}}), "reference");
    } else {
      if (entry.mark != Mark::points) {
        svg.path(polyline_path({{x * 1.0, center.y}, {x + 24.0, center.y}}),
                 "curve " + stroke_class(entry.color) +
                     (entry.mark == Mark::dashed_line ? " dashed" : ""));
      }
      if (entry.mark == Mark::points || entry.mark == Mark::line_and_points) {
        svg.path(mark_path(center, entry.color, 4), fill_class(entry.color));
      }
    }
    svg.text(x + 32, baseline, entry.name, "");
    x += needed;
  }
  return baseline + 10;
}

}  // namespace stormproof::plot
