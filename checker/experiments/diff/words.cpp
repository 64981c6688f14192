// Numbers as a person reads them.
#include "checker/experiments/diff/words.hpp"

#include <cmath>

#include <fmt/format.h>

#include "checker/presentation/text/figures.hpp"
#include "checker/presentation/text/numbers.hpp"

namespace stormproof::diff {

namespace {

std::string signed_value(Measure measure, double value) {
  if (std::isinf(value)) return value > 0 ? "+∞" : "−∞";
  const std::string sign = value > 0 ? "+" : value < 0 ? "−" : "±";
  return sign + value_text(measure, std::abs(value));
}

}  // namespace

std::string value_text(Measure measure, double value) {
  if (std::isinf(value)) return "never";
  if (measure == Measure::completion) return report::time_figure(value);
  if (measure == Measure::amplification) return fmt::format("{:.3g}×", value);
  return report::count_figure(value);
}

std::string value_text(Measure measure, const std::optional<double>& value) {
  return value ? value_text(measure, *value) : "–";
}

std::string median_text(Measure measure, const std::optional<double>& median) {
  return !median && measure == Measure::completion ? "never" : value_text(measure, median);
}

std::string median_text(const MeasuredChange& change, const std::optional<double>& median) {
  const bool is_cut = !median && change.cut_at && change.measure == Measure::completion;
  return is_cut ? "> " + report::duration(*change.cut_at) : median_text(change.measure, median);
}

std::string change_text(double relative) {
  if (std::isinf(relative)) return relative > 0 ? "+∞" : "−∞";
  if (relative >= 9) return fmt::format("×{:.3g}", 1 + relative);
  const double percent = 100 * relative;
  const double size = std::abs(percent);
  if (size == 0) return "±0 %";
  const char* sign = percent > 0 ? "+" : "−";
  if (size < 0.01) return fmt::format("{}<0.01 %", sign);
  if (size < 1) return fmt::format("{}{:.2f} %", sign, size);
  return size < 10 ? fmt::format("{}{:.1f} %", sign, size) : fmt::format("{}{:.0f} %", sign, size);
}

std::string change_text(const MeasuredChange& change) {
  if (!change.shift) return "–";
  const Shift& shift = *change.shift;
  if (change.relative) {
    if (shift.exact) return change_text(*change.relative);
    return fmt::format("{} ({} … {})", change_text(*change.relative),
                       change_text(*change.relative_low), change_text(*change.relative_high));
  }
  const std::string estimate = signed_value(change.measure, shift.estimate);
  if (shift.exact) return estimate;
  return fmt::format("{} ({} … {})", estimate, signed_value(change.measure, shift.low),
                     signed_value(change.measure, shift.high));
}

const char* matters_text(const KnobChange& change) {
  if (!change.modelled) return "not known";
  return change.matters ? "yes" : "no";
}

std::string share_text(double share) { return fmt::format("{:.4g} %", 100 * share); }

}  // namespace stormproof::diff
