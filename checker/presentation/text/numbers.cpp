// Formatting of numbers for text reports.
#include "checker/presentation/text/numbers.hpp"

#include <algorithm>
#include <cmath>

#include <fmt/core.h>

#include "checker/presentation/text/paragraph.hpp"

namespace stormproof::report {

namespace {

/// `digits` significant digits without an exponent, for positive values.
std::string significant(double value, int digits) {
  const int magnitude = value > 0 ? static_cast<int>(std::floor(std::log10(value))) : 0;
  return fmt::format("{:.{}f}", value, std::max(0, digits - 1 - magnitude));
}

}  // namespace

std::string grouped(std::uint64_t value) {
  std::string digits = std::to_string(value);
  for (std::ptrdiff_t k = static_cast<std::ptrdiff_t>(digits.size()) - 3; k > 0; k -= 3) {
    digits.insert(static_cast<std::size_t>(k), ",");
  }
  return digits;
}

std::string duration(model::Nanoseconds value) {
  const auto ns = static_cast<double>(value.count());
  if (value.count() == 0) return "0 s";
  if (ns < 1e3) return fmt::format("{} ns", value.count());
  if (ns < 1e6) return significant(ns / 1e3, 4) + " µs";
  if (ns < 1e9) return significant(ns / 1e6, 4) + " ms";
  return significant(ns / 1e9, 4) + " s";
}

std::string ratio(double value, double reference) {
  if (reference <= 0) return "–";
  const double quotient = value / reference;
  return significant(quotient, 3) + " ×";
}

std::string percent(double part, double whole) {
  return whole > 0 ? fmt::format("{:.1f} %", 100 * part / whole) : "–";
}

std::string bar(double share, std::size_t longest) {
  auto length = static_cast<std::size_t>(std::lround(share * static_cast<double>(longest)));
  if (share > 0) length = std::max<std::size_t>(length, 1);
  std::string blocks;
  for (std::size_t k = 0; k < length; ++k) blocks += "█";
  return blocks;
}

std::string right(const std::string& text, std::size_t width) {
  const std::size_t used = columns(text);
  return std::string(used < width ? width - used : 0, ' ') + text;
}

std::string left(const std::string& text, std::size_t width) {
  const std::size_t used = columns(text);
  return text + std::string(used < width ? width - used : 0, ' ');
}

}  // namespace stormproof::report
