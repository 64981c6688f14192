// All units are powers of ten of the base unit, so a decimal number with a unit is a string of
// digits with zeros appended: no multiplication by a factor, no rounding, one place where overflow
// can happen.
#include "model/config/tree/quantities.hpp"

#include <array>
#include <limits>
#include <numeric>
#include <span>

#include <fmt/core.h>

#include "model/config/tree/tree.hpp"

namespace stormproof::model::config {
namespace {

struct Unit {
  std::string_view name;
  int power_of_ten;
};

/// Largest first: `print` prefers the first of equally short spellings.
constexpr std::array<Unit, 4> duration_units{{{"s", 9}, {"ms", 6}, {"us", 3}, {"ns", 0}}};
constexpr std::array<Unit, 4> rate_units{{{"Gbps", 9}, {"Mbps", 6}, {"kbps", 3}, {"bps", 0}}};

constexpr bool is_digit(char c) { return c >= '0' && c <= '9'; }

/// A decimal number in text, cut at its point; trailing zeros of the fraction are gone.
struct Decimal {
  std::string_view whole;
  std::string_view fraction;
};

/// Takes a decimal number off the front of `text`; an empty `whole` if there is none.
Decimal take_decimal(std::string_view& text) {
  const auto take_digits = [&text] {
    std::size_t length = 0;
    while (length < text.size() && is_digit(text[length])) ++length;
    const std::string_view digits = text.substr(0, length);
    text.remove_prefix(length);
    return digits;
  };
  Decimal decimal{take_digits(), {}};
  if (decimal.whole.size() > 1 && decimal.whole.front() == '0') return {};
  if (!decimal.whole.empty() && text.starts_with('.')) {
    text.remove_prefix(1);
    decimal.fraction = take_digits();
    if (decimal.fraction.empty()) return {};
    while (decimal.fraction.ends_with('0')) decimal.fraction.remove_suffix(1);
  }
  return decimal;
}

/// `value`·10 + `digit`, or false if that overflows.
bool append_digit(std::int64_t& value, int digit) {
  if (value > (std::numeric_limits<std::int64_t>::max() - digit) / 10) return false;
  value = value * 10 + digit;
  return true;
}

/// `decimal` · 10^`power`, which must be at least the number of digits in the fraction.
Parsed<std::int64_t> scaled(const Decimal& decimal, int power, std::string_view text) {
  std::int64_t value = 0;
  bool fits = true;
  for (const char c : decimal.whole) fits = fits && append_digit(value, c - '0');
  for (const char c : decimal.fraction) fits = fits && append_digit(value, c - '0');
  for (int k = static_cast<int>(decimal.fraction.size()); k < power; ++k) {
    fits = fits && append_digit(value, 0);
  }
  if (!fits) return fmt::format("{} is too large", quote(text));
  return value;
}

std::string unit_names(std::span<const Unit> units) {
  std::string names;
  for (auto unit = units.rbegin(); unit != units.rend(); ++unit) {
    names += fmt::format("{}{}", names.empty() ? "" : ", ", unit->name);
  }
  return names;
}

Parsed<std::int64_t> parse_quantity(std::string_view text, std::span<const Unit> units) {
  std::string_view rest = text;
  if (text.starts_with('-')) return fmt::format("{} is negative", quote(text));
  const Decimal decimal = take_decimal(rest);
  if (decimal.whole.empty()) {
    return fmt::format("{} is not a number with a unit ({})", quote(text), unit_names(units));
  }
  if (rest.empty()) {
    return fmt::format("{} has no unit ({})", quote(text), unit_names(units));
  }
  for (const Unit& unit : units) {
    if (rest != unit.name) continue;
    if (decimal.fraction.size() > static_cast<std::size_t>(unit.power_of_ten)) {
      return fmt::format("{} is not a whole number of {}", quote(text), units.back().name);
    }
    return scaled(decimal, unit.power_of_ten, text);
  }
  return fmt::format("{} has the unknown unit {} (known: {})", quote(text), quote(rest),
                     unit_names(units));
}

std::string print_quantity(std::int64_t value, std::span<const Unit> units) {
  if (value == 0) return fmt::format("0{}", units.front().name);
  std::string shortest;
  for (const Unit& unit : units) {
    std::string digits = fmt::format("{}", value);
    if (digits.size() <= static_cast<std::size_t>(unit.power_of_ten)) continue;  // less than 1
    const std::size_t point = digits.size() - static_cast<std::size_t>(unit.power_of_ten);
    while (digits.size() > point && digits.ends_with('0')) digits.pop_back();
    if (digits.size() > point) digits.insert(point, 1, '.');
    digits += unit.name;
    if (shortest.empty() || digits.size() < shortest.size()) shortest = digits;
  }
  return shortest;
}

}  // namespace

Parsed<Nanoseconds> parse_duration(std::string_view text) {
  if (text == "0") return Nanoseconds{0};
  const auto count = parse_quantity(text, duration_units);
  if (!count) return count.error();
  return Nanoseconds{*count};
}

Parsed<BitsPerSecond> parse_rate(std::string_view text) {
  const auto count = parse_quantity(text, rate_units);
  if (!count) return count.error();
  return BitsPerSecond{*count};
}

Parsed<std::int64_t> parse_count(std::string_view text) {
  if (text.starts_with('-')) return fmt::format("{} is negative", quote(text));
  std::string_view rest = text;
  const Decimal decimal = take_decimal(rest);
  if (decimal.whole.empty() || decimal.whole.size() != text.size()) {
    return fmt::format("{} is not an integer in plain decimal digits", quote(text));
  }
  return scaled(decimal, 0, text);
}

Parsed<Fraction> parse_fraction(std::string_view text) {
  const std::string complaint = fmt::format("{} is not a decimal or a fraction", quote(text));
  Fraction fraction;
  if (const std::size_t slash = text.find('/'); slash != std::string_view::npos) {
    const auto numerator = parse_count(text.substr(0, slash));
    const auto denominator = parse_count(text.substr(slash + 1));
    if (!numerator || !denominator || *denominator == 0) return complaint;
    fraction = {*numerator, *denominator};
  } else {
    std::string_view rest = text;
    const Decimal decimal = take_decimal(rest);
    constexpr std::size_t most_digits = 18;
    if (decimal.whole.empty() || !rest.empty()) return complaint;
    if (decimal.fraction.size() > most_digits)
      return fmt::format("{} has too many digits", quote(text));
    const auto numerator = scaled(decimal, static_cast<int>(decimal.fraction.size()), text);
    if (!numerator) return numerator.error();
    fraction.numerator = *numerator;
    for (std::size_t k = 0; k < decimal.fraction.size(); ++k) fraction.denominator *= 10;
  }
  if (fraction.numerator == 0) return fmt::format("{} is not greater than 0", quote(text));
  const std::int64_t divisor = std::gcd(fraction.numerator, fraction.denominator);
  return Fraction{fraction.numerator / divisor, fraction.denominator / divisor};
}

Parsed<Fraction> parse_share(std::string_view text) {
  std::string_view number = text;
  const bool is_percent = number.ends_with('%');
  if (is_percent) number.remove_suffix(1);
  while (is_percent && number.ends_with(' ')) number.remove_suffix(1);
  if (number == "0") return Fraction{0, 1};
  const auto fraction = parse_fraction(number);
  if (!fraction) return fmt::format("{} is not a percentage, decimal or fraction", quote(text));
  if (!is_percent) return *fraction;
  constexpr std::int64_t hundred = 100;
  const std::int64_t common = std::gcd(fraction->numerator, hundred);
  if (fraction->denominator > INT64_MAX / hundred) {
    return fmt::format("{} has too many digits", quote(text));
  }
  return Fraction{fraction->numerator / common, fraction->denominator * (hundred / common)};
}

std::string print_duration(Nanoseconds duration) {
  return print_quantity(duration.count(), duration_units);
}

std::string print_rate(BitsPerSecond rate) { return print_quantity(rate.count(), rate_units); }

std::string print_fraction(const Fraction& fraction) {
  return fmt::format("{}/{}", fraction.numerator, fraction.denominator);
}

}  // namespace stormproof::model::config
