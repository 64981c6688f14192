// Line and scatter charts.
#include <algorithm>
#include <cmath>
#include <optional>
#include <utility>

#include <fmt/format.h>

#include "checker/presentation/charts/canvas.hpp"

namespace stormproof::plot {

namespace {

/// The part of the segment from `a` to `b` inside the area, if any (Liang and Barsky).
bool clip(Pixel& a, Pixel& b, const Area& area) {
  double from = 0;
  double to = 1;
  const double dx = b.x - a.x;
  const double dy = b.y - a.y;
  const auto keep = [&](double direction, double distance) {
    if (direction == 0) return distance >= 0;
    const double at = distance / direction;
    if (direction < 0) from = std::max(from, at);
    if (direction > 0) to = std::min(to, at);
    return from <= to;
  };
  if (!keep(-dx, a.x - area.left) || !keep(dx, area.right() - a.x) || !keep(-dy, a.y - area.top) ||
      !keep(dy, area.bottom() - a.y)) {
    return false;
  }
  const Pixel start = a;
  a = {start.x + from * dx, start.y + from * dy};
  b = {start.x + to * dx, start.y + to * dy};
  return true;
}

/// A text that keeps clear of those before.
struct Box {
  int x = 0;
  int y = 0;
  int width = 0;

  [[nodiscard]] bool touches(const Box& other) const {
    return x < other.x + other.width && other.x < x + width && std::abs(y - other.y) < line_height;
  }
};

class Drawing {
 public:
  Drawing(const Chart& chart, draw::Svg& svg, const ScaledAxis& x, const ScaledAxis& y, Area area)
      : chart_{chart}, svg_{svg}, x_{x}, y_{y}, area_{area} {}

  void references() {
    for (const Reference& reference : chart_.references) draw_reference(reference);
  }

  void series() {
    for (std::size_t k = 0; k < chart_.series.size(); ++k) {
      if (chart_.series[k].spread == Spread::band) band(chart_.series[k], color(k));
    }
    for (std::size_t k = 0; k < chart_.series.size(); ++k) {
      if (chart_.series[k].spread == Spread::bars) whiskers(chart_.series[k], color(k));
      curve(chart_.series[k], color(k));
    }
  }

  /// Texts come last, where they find a place clear of the curves.
  void labels() {
    for (const Reference& reference : chart_.references) {
      const auto line = line_of(reference);
      if (line && !reference.label.empty() && !is_in_legend(reference)) {
        place(beside(*line, reference), reference.label);
      }
    }
    for (const Annotation& note : chart_.annotations) {
      if (!x_.contains(note.x) || !y_.contains(note.y)) continue;
      place(around(at(note.x, note.y), draw::text_width(note.text, font_size)), note.text);
    }
  }

  [[nodiscard]] std::vector<LegendEntry> legend() const {
    std::vector<LegendEntry> entries;
    for (std::size_t k = 0; k < chart_.series.size(); ++k) {
      const Series& one = chart_.series[k];
      if (!one.name.empty()) entries.push_back({one.name, color(k), one.mark});
    }
    for (const Reference& one : chart_.references) {
      if (!is_in_legend(one) || one.label.empty()) continue;
      entries.push_back({.name = one.label, .reference = true});
    }
    return entries;
  }

 private:
  /// Data lie along a diagonal, so that no label has room beside it.
  [[nodiscard]] static bool is_in_legend(const Reference& reference) {
    return reference.kind == Reference::Kind::diagonal;
  }
  [[nodiscard]] std::size_t color(std::size_t k) const {
    return chart_.series[k].color.value_or(k);
  }
  [[nodiscard]] Pixel at(double x, double y) const {
    return {area_.x_at(x_.fraction(x)), area_.y_at(y_.fraction(y))};
  }
  [[nodiscard]] bool visible(double x, double y) const {
    return drawable(x, x_.scale()) && drawable(y, y_.scale());
  }
  [[nodiscard]] Pixel clamped(double x, double y) const {
    Pixel p = at(x, y);
    p.y = std::clamp(p.y, static_cast<double>(area_.top), static_cast<double>(area_.bottom()));
    return p;
  }

  using Line = std::pair<Pixel, Pixel>;

  void draw_reference(const Reference& reference) {
    const auto line = line_of(reference);
    if (!line) return;
    svg_.path(polyline_path({line->first, line->second}), "reference");
    strokes_.push_back(*line);
  }

  [[nodiscard]] std::optional<Line> line_of(const Reference& reference) const {
    double x1 = x_.low();
    double x2 = x_.high();
    double y1 = reference.value;
    double y2 = reference.value;
    if (reference.kind == Reference::Kind::vertical) {
      x1 = x2 = reference.value;
      y1 = y_.low();
      y2 = y_.high();
    } else if (reference.kind == Reference::Kind::diagonal) {
      // Where both axes have values; on mixed scales the straight line would be wrong.
      x1 = y1 = std::max(x_.low(), y_.low());
      x2 = y2 = std::min(x_.high(), y_.high());
      if (x1 >= x2 || x_.scale() != y_.scale()) return std::nullopt;
    }
    if (!x_.contains(x1) || !y_.contains(y1) || !x_.contains(x2) || !y_.contains(y2)) {
      return std::nullopt;
    }
    return Line{at(x1, y1), at(x2, y2)};
  }

  /// Places along a level or upright line, best first: the one has its label above it at the right
  /// end, the other beside it from the top down.
  [[nodiscard]] std::vector<Box> beside(const Line& line, const Reference& reference) const {
    const int width = draw::text_width(reference.label, font_size);
    const int x = static_cast<int>(std::lround(line.second.x));
    const int y = static_cast<int>(std::lround(line.second.y));
    std::vector<Box> places;
    if (reference.kind == Reference::Kind::vertical) {
      for (int down = y + 16; down < area_.bottom(); down += line_height) {
        places.push_back({x + 6, down, width});
        places.push_back({x - 6 - width, down, width});
      }
      return places;
    }
    for (int end = x - 8; end - width > area_.left; end -= 24) {
      places.push_back({end - width, y - 6, width});
      places.push_back({end - width, y + line_height, width});
    }
    return places;
  }

  void curve(const Series& one, std::size_t color) {
    std::string line;
    std::string marks;
    std::size_t points = 0;
    bool connected = false;
    Pixel before;
    for (std::size_t k = 0; k < std::min(one.x.size(), one.y.size()); ++k) {
      if (!visible(one.x[k], one.y[k])) {
        connected = false;
        continue;
      }
      const Pixel here = at(one.x[k], one.y[k]);
      Pixel a = before;
      Pixel b = here;
      if (connected && one.mark != Mark::points && one.mark != Mark::crosses && clip(a, b, area_)) {
        strokes_.emplace_back(a, b);
        // One stroke as long as nothing is cut off, so that dashes run through.
        const std::string piece = polyline_path({a, b});
        const std::size_t next = piece.find('L');
        line +=
            !line.empty() && line.ends_with(piece.substr(1, next - 1)) ? piece.substr(next) : piece;
      }
      connected = true;
      before = here;
      if (!x_.contains(one.x[k]) || !y_.contains(one.y[k])) continue;
      marks += one.mark == Mark::crosses
                   ? cross_path(here)
                   : mark_path(here, color, one.mark == Mark::points ? 3.2 : 3.5);
      ++points;
    }
    if (one.mark == Mark::crosses) {
      if (!marks.empty()) svg_.path(marks, "curve " + stroke_class(color));
      return;
    }
    if (one.mark != Mark::points && !line.empty()) {
      svg_.path(line,
                "curve " + stroke_class(color) + (one.mark == Mark::dashed_line ? " dashed" : ""));
    }
    if ((one.mark == Mark::points || one.mark == Mark::line_and_points) && !marks.empty()) {
      svg_.path(marks, fill_class(color) + (points > 150 ? " many" : ""));
    }
  }

  static std::string cross_path(Pixel p) {
    return fmt::format("M{:.1f} {:.1f}l10 10M{:.1f} {:.1f}l-10 10", p.x - 5, p.y - 5, p.x + 5,
                       p.y - 5);
  }

  [[nodiscard]] bool has_spread(const Series& one, std::size_t k) const {
    return k < one.low.size() && k < one.high.size() && k < one.x.size() && x_.contains(one.x[k]) &&
           drawable(one.low[k], y_.scale()) && drawable(one.high[k], y_.scale());
  }

  void whiskers(const Series& one, std::size_t color) {
    std::string path;
    for (std::size_t k = 0; k < one.x.size(); ++k) {
      if (!has_spread(one, k)) continue;
      const Pixel low = clamped(one.x[k], one.low[k]);
      const Pixel high = clamped(one.x[k], one.high[k]);
      strokes_.emplace_back(low, high);
      path += fmt::format("M{:.1f} {:.1f}V{:.1f}M{:.1f} {:.1f}h6M{:.1f} {:.1f}h6", low.x, low.y,
                          high.y, low.x - 3, low.y, low.x - 3, high.y);
    }
    if (!path.empty()) svg_.path(path, "whisker " + stroke_class(color));
  }

  void band(const Series& one, std::size_t color) {
    std::vector<Pixel> upper;
    std::vector<Pixel> lower;
    const auto close = [&] {
      if (upper.size() > 1) {
        upper.insert(upper.end(), lower.rbegin(), lower.rend());
        svg_.path(polyline_path(upper) + "z", "band " + fill_class(color));
      }
      upper.clear();
      lower.clear();
    };
    for (std::size_t k = 0; k < one.x.size(); ++k) {
      if (!has_spread(one, k)) {
        close();
        continue;
      }
      upper.push_back(clamped(one.x[k], one.high[k]));
      lower.push_back(clamped(one.x[k], one.low[k]));
    }
    close();
  }

  /// Places beside a point.
  [[nodiscard]] static std::vector<Box> around(Pixel point, int width) {
    const int x = static_cast<int>(std::lround(point.x));
    const int y = static_cast<int>(std::lround(point.y));
    return {{x + 8, y + 4, width},         {x - 8 - width, y + 4, width},
            {x - width / 2, y - 8, width}, {x - width / 2, y + 18, width},
            {x + 8, y + 20, width},        {x - 8 - width, y + 20, width},
            {x - 8 - width, y - 12, width}};
  }

  /// Whether a curve runs through the text.
  [[nodiscard]] bool struck(const Box& box) const {
    const Area room{box.x - 2, box.y - line_height + 4, box.width + 4, line_height};
    return std::ranges::any_of(
        strokes_, [&](Line stroke) { return clip(stroke.first, stroke.second, room); });
  }

  /// Where no other text and no curve is; then where no other text is; else at the second place,
  /// above all others.
  void place(const std::vector<Box>& places, const std::string& text) {
    if (places.empty()) return;
    const auto fits = [&](const Box& box) {
      return box.x >= area_.left && box.x + box.width <= area_.right() && box.y >= area_.top + 10 &&
             box.y <= area_.bottom() - 2 &&
             std::none_of(texts_.begin(), texts_.end(),
                          [&](const Box& other) { return box.touches(other); });
    };
    auto box = std::find_if(places.begin(), places.end(),
                            [&](const Box& one) { return fits(one) && !struck(one); });
    if (box == places.end()) box = std::find_if(places.begin(), places.end(), fits);
    if (box == places.end()) box = places.begin() + (places.size() > 1 ? 1 : 0);
    svg_.text(std::max(box->x, area_.left), box->y, text, "halo quiet");
    texts_.push_back(*box);
  }

  const Chart& chart_;
  draw::Svg& svg_;
  const ScaledAxis& x_;
  const ScaledAxis& y_;
  Area area_;
  std::vector<Box> texts_;
  std::vector<Line> strokes_;  ///< of all curves
};

DataRange range_of(const Chart& chart, bool vertical) {
  DataRange range{(vertical ? chart.y : chart.x).scale};
  for (const Series& one : chart.series) {
    for (std::size_t k = 0; k < std::min(one.x.size(), one.y.size()); ++k) {
      if (!drawable(one.x[k], chart.x.scale) || !drawable(one.y[k], chart.y.scale)) continue;
      range.add(vertical ? one.y[k] : one.x[k]);
    }
    if (!vertical) continue;
    for (const double value : one.low) range.add(value);
    for (const double value : one.high) range.add(value);
  }
  for (const Reference& line : chart.references) {
    const auto kind = vertical ? Reference::Kind::horizontal : Reference::Kind::vertical;
    if (line.kind == kind) range.add(line.value);
  }
  return range;
}

}  // namespace

std::string to_svg(const Chart& chart) {
  const int width = std::clamp(chart.width, 240, 4000);
  const int height = std::clamp(chart.height, 160, 4000);
  const ScaledAxis y{chart.y, range_of(chart, true), (height - 100) / 55.0};
  Area area;
  draw::Svg svg{chart.title, chart.description};
  area.top = draw_title(svg, chart.title, width) + (chart.y.label.empty() ? 8 : 26);
  area.left = 16 + label_width(y) + 8;
  area.width = width - area.left - 24;
  area.height = std::max(60, height - area.top - 46);
  const ScaledAxis x{chart.x, range_of(chart, false), area.width / 75.0};
  draw_y_axis(svg, y, chart.y.label, area);
  const int below = draw_x_axis(svg, x, chart.x.label, area);
  svg.rect(area.left, area.top, area.width, area.height, "frame");
  Drawing drawing{chart, svg, x, y, area};
  drawing.references();
  drawing.series();
  drawing.labels();
  const int end = draw_legend(svg, drawing.legend(), 12, below, width - 12);
  return svg.finish(width, std::max(height, end + 6), chart_style());
}

}  // namespace stormproof::plot
