// From values to pixels: the range of an axis, its ticks at round values, and their labels with SI
// prefixes.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "checker/presentation/charts/plot.hpp"

namespace stormproof::plot {

/// Whether a value has a place on such an axis: finite, at most 1e300 in size, and positive on a
/// log axis.
[[nodiscard]] bool drawable(double value, Scale scale);

/// `value` with at most `digits` significant digits and the SI prefix that fits: 0.0125 s →
/// "12.5 ms". "–" if it is not finite.
[[nodiscard]] std::string si_text(double value, const std::string& unit, int digits = 3);

struct Tick {
  double value = 0;
  std::string text;
};

/// The values that an axis has to show.
class DataRange {
 public:
  explicit DataRange(Scale scale) : scale_{scale} {}
  void add(double value);

  [[nodiscard]] bool empty() const { return !low_.has_value(); }
  [[nodiscard]] double low() const { return low_.value_or(scale_ == Scale::log ? 1 : 0); }
  [[nodiscard]] double high() const { return high_.value_or(scale_ == Scale::log ? 10 : 1); }

 private:
  Scale scale_;
  std::optional<double> low_;
  std::optional<double> high_;
};

/// An axis with its range settled, `pixels` long.
class ScaledAxis {
 public:
  /// `wanted_ticks` is about how many ticks there is room for.
  ScaledAxis(const Axis& axis, const DataRange& data, double wanted_ticks);

  /// 0 at the low end and 1 at the high end; only for drawable values.
  [[nodiscard]] double fraction(double value) const;
  [[nodiscard]] bool contains(double value) const;
  [[nodiscard]] const std::vector<Tick>& ticks() const { return ticks_; }
  [[nodiscard]] double low() const { return low_; }
  [[nodiscard]] double high() const { return high_; }
  [[nodiscard]] Scale scale() const { return scale_; }

 private:
  void settle_linear(const Axis& axis, const DataRange& data, double wanted_ticks);
  void settle_log(const Axis& axis, const DataRange& data, double wanted_ticks);
  void label_linear(const std::string& unit, double step);

  Scale scale_;
  double low_ = 0;
  double high_ = 1;
  std::vector<Tick> ticks_;
};

}  // namespace stormproof::plot
