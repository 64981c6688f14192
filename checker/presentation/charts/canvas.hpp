// What all charts share: the frame with axes, grid, title and legend, and the colours and marks of
// series.
#pragma once

#include <string>
#include <vector>

#include "checker/presentation/charts/axis.hpp"
#include "checker/presentation/diagrams/svg.hpp"

namespace stormproof::plot {

/// A point in pixels.
struct Pixel {
  double x = 0;
  double y = 0;
};

/// The rectangle that values are drawn in; y grows downwards.
struct Area {
  int left = 0;
  int top = 0;
  int width = 0;
  int height = 0;

  [[nodiscard]] double x_at(double fraction) const { return left + fraction * width; }
  [[nodiscard]] double y_at(double fraction) const { return top + (1 - fraction) * height; }
  [[nodiscard]] int right() const { return left + width; }
  [[nodiscard]] int bottom() const { return top + height; }
};

inline constexpr int font_size = 12;
inline constexpr int line_height = 16;
inline constexpr std::size_t color_count = 12;

/// The colours of series and their classes, for draw::Svg::finish.
[[nodiscard]] std::string palette_style();
/// The classes of all charts, those of the palette included.
[[nodiscard]] std::string chart_style();

/// Class names of colour k: of a line, of a filled shape.
[[nodiscard]] std::string stroke_class(std::size_t color);
[[nodiscard]] std::string fill_class(std::size_t color);

/// SVG path of the mark of colour k at this place: circle, square, diamond, triangles, cross.
[[nodiscard]] std::string mark_path(Pixel at, std::size_t color, double radius);
[[nodiscard]] std::string polyline_path(const std::vector<Pixel>& points);
[[nodiscard]] std::string rectangle_path(double x, double y, double width, double height);

/// Title at the top; returns the first free y below it.
int draw_title(draw::Svg& svg, const std::string& title, int width);

/// Grid, tick labels and label of a horizontal axis below `area`; labels that would touch the one
/// before are left out. Returns the first free y below.
int draw_x_axis(draw::Svg& svg, const ScaledAxis& axis, const std::string& label, const Area& area);
/// The same of a vertical axis at the left; its label goes above it.
void draw_y_axis(draw::Svg& svg, const ScaledAxis& axis, const std::string& label,
                 const Area& area);
/// Width of the widest tick label.
[[nodiscard]] int label_width(const ScaledAxis& axis);

/// One entry of a legend.
struct LegendEntry {
  std::string name;
  std::size_t color = 0;
  Mark mark = Mark::line_and_points;
  bool block = false;      ///< a filled rectangle: bars
  bool reference = false;  ///< a thin dotted line, which has no colour of its own
};
/// Entries in rows from `y` on; returns the first free y below.
int draw_legend(draw::Svg& svg, const std::vector<LegendEntry>& entries, int left, int y,
                int width);

}  // namespace stormproof::plot
