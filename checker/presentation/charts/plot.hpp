// Charts of results, as self-contained SVG documents in the style of the drawn machines: light or
// dark as the viewer prefers, no fonts or scripts from elsewhere, so that a chart opens anywhere
// and can be put into an HTML page as it is. A chart is data; `to_svg` draws it.
#pragma once

#include <optional>
#include <string>
#include <vector>

namespace stormproof::plot {

enum class Scale { linear, log };

/// One axis. Its range is that of the data, widened to whole ticks, unless `min` or `max` are
/// given; what lies outside of them is cut off. On a log axis values ≤ 0 are gaps.
struct Axis {
  std::string label{};
  Scale scale = Scale::linear;
  std::optional<double> min{};
  std::optional<double> max{};
  /// Base unit of the values, shown with SI prefixes: "s" gives "10 ms". Empty: plain numbers with
  /// k, M, G. "%" and other words that take no prefix: write them into the label instead.
  std::string unit{};
  /// Ticks at these values instead of chosen ones; those without room get no label.
  std::vector<double> ticks{};
};

/// `crosses`: ✗ where something ends, without a line.
enum class Mark { line, points, line_and_points, dashed_line, crosses };
/// How `low` and `high` of a series are drawn: as a bar at each point, or as one shaded band.
enum class Spread { bars, band };

/// One data set. `x` and `y` have the same length; NaN and infinities are gaps. `low` and `high`
/// are empty, or have this length, too.
struct Series {
  std::string name{};  ///< in the legend; empty: not listed there
  std::vector<double> x{};
  std::vector<double> y{};
  std::vector<double> low{};
  std::vector<double> high{};
  Mark mark = Mark::line_and_points;
  Spread spread = Spread::bars;
  /// Series of the same colour number belong together (model and measurement, say); absent: the
  /// position in the chart.
  std::optional<std::size_t> color{};
};

/// A thin line across the chart: y = x, or one value of x or y.
struct Reference {
  enum class Kind { diagonal, horizontal, vertical };
  Kind kind = Kind::diagonal;
  double value = 0;     ///< of x or y; not used by the diagonal
  std::string label{};  ///< beside it, of a diagonal in the legend; may be empty
};

/// A text beside a point of the chart.
struct Annotation {
  double x = 0;
  double y = 0;
  std::string text{};
};

/// Pixels: two charts of this width stand side by side on a page.
inline constexpr int beside = 570;

struct Chart {
  std::string title{};
  std::string description{};  ///< for those who cannot see the chart
  Axis x{};
  Axis y{};
  std::vector<Series> series{};
  std::vector<Reference> references{};
  std::vector<Annotation> annotations{};
  int width = beside;  ///< pixels, 240 … 4000
  int height = 420;    ///< pixels, 160 … 4000, with the legend below it on top of that
};
[[nodiscard]] std::string to_svg(const Chart& chart);

/// Horizontal bars in groups: one group for each category, in it one bar for each series. On a log
/// axis, which has no zero to begin at, marks instead of bars.
struct BarChart {
  struct Group {
    std::string name{};            ///< in the legend
    std::vector<double> values{};  ///< one for each category; NaN: no bar
  };
  std::string title{};
  std::string description{};
  Axis value{};
  std::vector<std::string> categories{};
  std::vector<Group> groups{};
  int width = beside;  ///< pixels; the height follows
};
[[nodiscard]] std::string to_svg(const BarChart& chart);

/// What the change of each input does to a result: one bar from `low` to `high` across `base`, in
/// the given order, from above.
struct Tornado {
  struct Bar {
    std::string name{};
    double low = 0;   ///< the result with the input at its lower value
    double high = 0;  ///< … and at its higher value; may be less than `low`. NaN: not known
    std::string low_text{};   ///< the lower value of the input, at that end of the bar
    std::string high_text{};  ///< the higher one
  };
  std::string title{};
  std::string description{};
  Axis value{};
  double base = 0;  ///< the result without a change
  std::vector<Bar> bars{};
  int width = 760;  ///< pixels; the height follows
};
[[nodiscard]] std::string to_svg(const Tornado& chart);

/// A surface seen from above: one cell for each x and y, its colour the value.
struct HeatMap {
  std::string title{};
  std::string description{};
  std::string x_label{};
  std::string y_label{};
  std::vector<std::string> x{};              ///< names of the columns
  std::vector<std::string> y{};              ///< names of the rows, from below
  std::vector<std::vector<double>> value{};  ///< [row][column]; NaN: an empty cell
  std::string value_label{};                 ///< of the colour scale
  std::string unit{};                        ///< as in Axis
  Scale scale = Scale::linear;               ///< of the colours
  std::optional<double> min{};               ///< of the colours; absent: those of the data
  std::optional<double> max{};
  int width = 760;  ///< pixels; the height follows
};
[[nodiscard]] std::string to_svg(const HeatMap& chart);

}  // namespace stormproof::plot
