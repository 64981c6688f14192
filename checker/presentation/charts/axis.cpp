// Ticks lie at 1, 2 or 5 times a power of ten, on log axes at powers of ten if there are enough.
#include "checker/presentation/charts/axis.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include <fmt/format.h>

namespace stormproof::plot {

namespace {

constexpr double largest = 1e300;
constexpr int max_ticks = 60;
constexpr std::array<const char*, 11> prefixes{"f", "p", "n", "µ", "m", "",
                                               "k", "M", "G", "T", "P"};
constexpr int no_prefix = 5;

/// Which prefix fits a number: its position in `prefixes`. A number without a unit is not written
/// in thousandths.
int prefix_of(double size, bool has_unit) {
  if (size <= 0) return no_prefix;
  const int triple = static_cast<int>(std::floor(std::log10(size) / 3 + 1e-9));
  const int least = has_unit ? 0 : no_prefix;
  return std::clamp(triple + no_prefix, least, static_cast<int>(prefixes.size()) - 1);
}

/// "{:g}" without an exponent for the digits that labels have.
std::string plain(double value, int digits) {
  const double size = std::abs(value);
  if (size != 0 && (size < 1e-4 || size >= 1e15)) return fmt::format("{:.{}g}", value, digits);
  const int whole = size == 0 ? 1 : static_cast<int>(std::floor(std::log10(size))) + 1;
  std::string text = fmt::format("{:.{}f}", value, std::clamp(digits - whole, 0, 12));
  if (text.find('.') != std::string::npos) {
    text.erase(text.find_last_not_of('0') + 1);
    if (text.back() == '.') text.pop_back();
  }
  return text == "-0" ? "0" : text;
}

std::string with_prefix(double value, const std::string& unit, int digits, int prefix) {
  if (value == 0) return "0";
  const double scaled = value / std::pow(1000.0, prefix - no_prefix);
  const std::string name = prefixes[static_cast<std::size_t>(prefix)] + unit;
  return plain(scaled, digits) + (unit.empty() || name.empty() ? "" : " ") + name;
}

/// The least of 1, 2 and 5 times a power of ten that is not below `step`.
double nice_step(double step) {
  const double power = std::pow(10.0, std::floor(std::log10(step)));
  for (const double factor : {1.0, 2.0, 5.0}) {
    if (step <= factor * power * (1 + 1e-9)) return factor * power;
  }
  return 10 * power;
}

/// 1, 2 and 5 times the powers of ten from below `low` to above `high`.
std::vector<double> one_two_five(double low, double high) {
  std::vector<double> values;
  const int first = static_cast<int>(std::floor(std::log10(low) + 1e-9)) - 1;
  const int last = static_cast<int>(std::ceil(std::log10(high) - 1e-9)) + 1;
  for (int exponent = first; exponent <= last; ++exponent) {
    for (const double factor : {1.0, 2.0, 5.0}) values.push_back(factor * std::pow(10.0, exponent));
  }
  return values;
}

}  // namespace

bool drawable(double value, Scale scale) {
  if (!std::isfinite(value) || std::abs(value) > largest) return false;
  return scale == Scale::linear || value > 1 / largest;
}

std::string si_text(double value, const std::string& unit, int digits) {
  if (!std::isfinite(value)) return "–";
  if (value == 0) return unit.empty() ? "0" : "0 " + unit;
  // Rounded first, so that 999.9 m does not become 1000 m.
  const double power = std::pow(10.0, std::floor(std::log10(std::abs(value))) - digits + 1);
  const double rounded = std::abs(value) < largest && power > 0 && std::isfinite(power)
                             ? std::round(value / power) * power
                             : value;
  return with_prefix(rounded, unit, digits, prefix_of(std::abs(rounded), !unit.empty()));
}

void DataRange::add(double value) {
  if (!drawable(value, scale_)) return;
  low_ = std::min(low_.value_or(value), value);
  high_ = std::max(high_.value_or(value), value);
}

ScaledAxis::ScaledAxis(const Axis& axis, const DataRange& data, double wanted_ticks)
    : scale_{axis.scale} {
  wanted_ticks = std::clamp(wanted_ticks, 2.0, 20.0);
  if (scale_ == Scale::log) {
    settle_log(axis, data, wanted_ticks);
  } else {
    settle_linear(axis, data, wanted_ticks);
  }
  if (axis.ticks.empty()) return;
  ticks_.clear();
  for (const double value : axis.ticks) {
    if (contains(value)) ticks_.push_back({value, si_text(value, axis.unit)});
  }
}

void ScaledAxis::settle_linear(const Axis& axis, const DataRange& data, double wanted_ticks) {
  low_ = axis.min.value_or(data.low());
  high_ = axis.max.value_or(data.high());
  if (!drawable(low_, scale_)) low_ = 0;
  if (!drawable(high_, scale_)) high_ = low_;
  // Bars and curves are easier to compare from zero, if that wastes at most half of the room.
  if (!axis.min && low_ > 0 && low_ < high_ / 2) low_ = 0;
  const double least = std::max(std::abs(low_), std::abs(high_)) * 1e-12;
  if (high_ - low_ <= least) {
    const double half = std::max(std::abs(low_) * 0.1, least > 0 ? least : 1.0);
    if (!axis.min) low_ -= half;
    high_ = low_ + 2 * half;
  }
  const double step = nice_step((high_ - low_) / wanted_ticks);
  if (!axis.min) low_ = std::floor(low_ / step + 1e-9) * step;
  if (!axis.max) high_ = std::ceil(high_ / step - 1e-9) * step;
  const double first = std::ceil(low_ / step - 1e-9);
  for (int k = 0; k < max_ticks && (first + k) * step <= high_ + step * 1e-6; ++k) {
    const double value = (first + k) * step;
    ticks_.push_back({std::abs(value) < step / 2 ? 0 : value, ""});
  }
  label_linear(axis.unit, step);
}

void ScaledAxis::label_linear(const std::string& unit, double step) {
  // One prefix for the whole axis, and as many digits as tell neighbours apart.
  const double size = std::max(std::abs(low_), std::abs(high_));
  const int prefix = prefix_of(size, !unit.empty());
  const int digits = std::clamp(static_cast<int>(std::ceil(std::log10(size / step))) + 2, 3, 15);
  for (Tick& tick : ticks_) {
    const double scaled = tick.value / std::pow(1000.0, prefix - no_prefix);
    const int whole = std::abs(scaled) < 1 ? 0 : static_cast<int>(std::log10(std::abs(scaled)));
    tick.text = with_prefix(tick.value, unit, std::max(digits, whole + 1), prefix);
  }
}

void ScaledAxis::settle_log(const Axis& axis, const DataRange& data, double wanted_ticks) {
  low_ = axis.min.value_or(data.low());
  high_ = axis.max.value_or(data.high());
  if (!drawable(low_, scale_)) low_ = 1;
  if (!drawable(high_, scale_) || high_ < low_) high_ = low_;
  if (high_ < low_ * 1.001) {
    if (!axis.min) low_ /= 2;
    high_ = low_ * 4;
  }
  const std::vector<double> all = one_two_five(low_, high_);
  if (!axis.min) {
    low_ = *std::prev(std::upper_bound(all.begin(), all.end(), low_ * (1 + 1e-9)));
  }
  if (!axis.max) high_ = *std::lower_bound(all.begin(), all.end(), high_ * (1 - 1e-9));
  const double decades = std::log10(high_ / low_);
  const int every = std::max(1, static_cast<int>(std::ceil(decades / (1.4 * wanted_ticks))));
  for (std::size_t k = 0; k < all.size() && ticks_.size() < max_ticks; ++k) {
    const int exponent = static_cast<int>(std::lround(std::log10(all[k - k % 3])));
    const bool decade = k % 3 == 0;
    if (decades * 3 > wanted_ticks && (!decade || exponent % every != 0)) continue;
    if (contains(all[k])) ticks_.push_back({all[k], si_text(all[k], axis.unit)});
  }
}

double ScaledAxis::fraction(double value) const {
  if (scale_ == Scale::log) return std::log(value / low_) / std::log(high_ / low_);
  return (value - low_) / (high_ - low_);
}

bool ScaledAxis::contains(double value) const {
  if (!drawable(value, scale_)) return false;
  const double at = fraction(value);
  return at >= -1e-9 && at <= 1 + 1e-9;
}

}  // namespace stormproof::plot
