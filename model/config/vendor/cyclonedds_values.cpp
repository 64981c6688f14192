// A number is read as an integer with a unit if it is one, and otherwise as a decimal, rounded to
// the nearest ns or byte; so does the library.
#include "model/config/vendor/cyclonedds_values.hpp"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <span>
#include <system_error>

#include <fmt/core.h>

#include "model/config/tree/tree.hpp"
#include "model/config/vendor/any_case.hpp"

namespace stormproof::model::config::vendor {
namespace {

struct Unit {
  std::string_view name;
  std::int64_t factor;
};

constexpr Unit durations[] = {{"ns", 1},
                              {"us", 1'000},
                              {"ms", 1'000'000},
                              {"s", 1'000'000'000},
                              {"min", 60'000'000'000},
                              {"hr", 3'600'000'000'000},
                              {"day", 86'400'000'000'000}};
/// kB is 1024 B in this library.
constexpr Unit sizes[] = {
    {"B", 1},          {"KiB", 1024},          {"kB", 1024},         {"MiB", 1'048'576},
    {"MB", 1'048'576}, {"GiB", 1'073'741'824}, {"GB", 1'073'741'824}};

std::span<const Unit> units_of(CycloneKind kind) {
  if (kind == CycloneKind::duration) return durations;
  if (kind == CycloneKind::size) return sizes;
  return {};
}

std::string unit_names(std::span<const Unit> units) {
  std::string list;
  for (const Unit& unit : units) list += fmt::format("{}{}", list.empty() ? "" : ", ", unit.name);
  return list;
}

std::string with_spaces(std::string_view words) {
  std::string list;
  for (const char c : words) list += c == ',' ? std::string{", "} : std::string{c};
  return list;
}

/// Whether `word` is one of `words`, without regard to case.
bool is_among(std::string_view word, std::string_view words) {
  while (!words.empty()) {
    const std::size_t comma = std::min(words.find(','), words.size());
    if (is_same_word(word, words.substr(0, comma))) return true;
    words.remove_prefix(std::min(comma + 1, words.size()));
  }
  return false;
}

std::string print_amount(CycloneKind kind, std::int64_t amount) {
  if (kind == CycloneKind::duration) return print_cyclone_duration(amount);
  return kind == CycloneKind::size ? fmt::format("{} B", amount) : fmt::format("{}", amount);
}

/// `digits` times `factor` into `amount`, or why that is not possible.
std::string_view scale(std::string_view digits, std::int64_t factor, const CycloneType& type,
                       std::int64_t& amount) {
  std::int64_t whole = 0;
  const char* const end = digits.data() + digits.size();
  const auto [rest, failed] = std::from_chars(digits.data(), end, whole);
  if (rest == end && failed == std::errc{}) {
    if (__builtin_mul_overflow(whole, factor, &amount)) return "is out of range";
  } else {
    double decimal = 0;
    const auto [stop, wrong] = std::from_chars(digits.data(), end, decimal);
    if (stop != end) return "is not a number";
    if (wrong != std::errc{}) return "is out of range";
    const double scaled = std::floor(decimal * static_cast<double>(factor) + 0.5);
    if (!(std::abs(scaled) < 9e18)) return "is out of range";
    amount = static_cast<std::int64_t>(scaled);
  }
  return amount < type.minimum || amount > type.maximum ? "is out of range" : "";
}

Parsed<CycloneValue> parse_number(const CycloneType& type, std::string_view text) {
  const std::string shown = quote(text);
  std::string_view digits = text.substr(0, text.find_first_not_of("0123456789.+-"));
  std::string_view unit = text.substr(digits.size());
  if (digits.starts_with('+')) digits.remove_prefix(1);
  if (digits.empty()) return fmt::format("{} is not a number", shown);
  unit.remove_prefix(std::min(unit.find_first_not_of(' '), unit.size()));

  CycloneValue value;
  const std::span<const Unit> units = units_of(type.kind);
  const auto known = std::ranges::find(units, unit, &Unit::name);
  const bool is_zero = digits.find_first_not_of("0.") == std::string_view::npos;
  std::int64_t factor = 1;
  if (known != units.end()) {
    factor = known->factor;
  } else if (!unit.empty()) {
    return units.empty()
               ? fmt::format("{} is not an integer", shown)
               : fmt::format("{} has the unit {}, which does not exist", shown, quote(unit));
  } else if (type.kind == CycloneKind::duration && !is_zero) {
    return fmt::format("{} has no unit", shown);
  } else {
    value.lacks_unit = type.kind == CycloneKind::size && !is_zero;
  }
  if (units.empty() && digits.find('.') != std::string_view::npos) {
    return fmt::format("{} is not an integer", shown);
  }
  const std::string_view wrong = scale(digits, factor, type, value.number);
  if (!wrong.empty()) return fmt::format("{} {}", shown, wrong);
  return value;
}

Parsed<CycloneValue> parse_choices(const CycloneType& type, std::string_view text) {
  for (std::string_view rest = text; !rest.empty();) {
    const std::size_t comma = std::min(rest.find(','), rest.size());
    const std::string_view word = rest.substr(0, comma);
    if (!is_among(word, type.words))
      return fmt::format("{} has the word {}", quote(text), quote(word));
    rest.remove_prefix(std::min(comma + 1, rest.size()));
  }
  return CycloneValue{.word = in_lower_case(text)};
}

}  // namespace

std::string expectation(const CycloneType& type) {
  const std::string or_word =
      type.words.empty() ? "" : fmt::format(", or {}", with_spaces(type.words));
  switch (type.kind) {
    case CycloneKind::text:
      return "text";
    case CycloneKind::boolean:
      return "true or false";
    case CycloneKind::choice:
      return fmt::format("one of {}", with_spaces(type.words));
    case CycloneKind::choices:
      return fmt::format("a list, with commas, of {}", with_spaces(type.words));
    case CycloneKind::integer:
      return fmt::format("an integer from {} to {}{}", type.minimum, type.maximum, or_word);
    case CycloneKind::size:
    case CycloneKind::duration:
      break;
  }
  const bool is_duration = type.kind == CycloneKind::duration;
  const bool is_bounded = type.maximum != cyclone_longest_ns;
  return fmt::format("{} with its unit ({}) from {}{}{}", is_duration ? "a duration" : "a size",
                     unit_names(units_of(type.kind)), print_amount(type.kind, type.minimum),
                     is_bounded ? fmt::format(" to {}", print_amount(type.kind, type.maximum)) : "",
                     or_word);
}

Parsed<CycloneValue> parse_cyclone(const CycloneType& type, std::string_view text) {
  if (type.kind == CycloneKind::text) return CycloneValue{.word = std::string{text}};
  switch (type.kind) {
    case CycloneKind::boolean:
      if (!is_among(text, "false,true")) return fmt::format("{} is neither", quote(text));
      return CycloneValue{.number = is_same_word(text, "true") ? 1 : 0,
                          .word = in_lower_case(text)};
    case CycloneKind::choices:
      return parse_choices(type, text);
    case CycloneKind::choice:
      if (!is_among(text, type.words)) return fmt::format("{} is no such word", quote(text));
      return CycloneValue{.word = in_lower_case(text)};
    default:
      if (is_among(text, type.words)) return CycloneValue{.word = in_lower_case(text)};
      return parse_number(type, text);
  }
}

std::string print_cyclone_duration(std::int64_t nanoseconds) {
  if (nanoseconds == 0) return "0 s";
  const Unit* unit = durations;
  for (const Unit& candidate : durations) {
    if (nanoseconds % candidate.factor == 0) unit = &candidate;
  }
  return fmt::format("{} {}", nanoseconds / unit->factor, unit->name);
}

}  // namespace stormproof::model::config::vendor
