// Reading and describing of the kinds of value that do not depend on a template parameter.
#include "model/config/knobs/value_types.hpp"

#include <algorithm>
#include <charconv>
#include <limits>

#include <fmt/core.h>
#include <fmt/ranges.h>

#include "model/config/tree/suggestion.hpp"

namespace stormproof::model::config {
namespace {

/// A quantity's number without its dimension, for the tables that hold all kinds of range.
template <class Quantity>
Parsed<std::int64_t> plain(const Parsed<Quantity>& parsed) {
  if (!parsed) return parsed.error();
  return parsed->count();
}

Fault fault(const Node& node, std::string_view reason) {
  return {node.place, node.shown() + std::string{reason}};
}

}  // namespace

std::string NumberType::print(std::int64_t count) const {
  switch (unit_) {
    case Unit::nanoseconds:
      return print_duration(Nanoseconds{count});
    case Unit::bits_per_second:
      return print_rate(BitsPerSecond{count});
    case Unit::bytes:
    case Unit::things:
      break;
  }
  return fmt::format("{}", count);
}

Complaint NumberType::read_count(const Node& node, std::int64_t& count) const {
  const bool has_unit = unit_ == Unit::nanoseconds || unit_ == Unit::bits_per_second;
  if (!node.is_scalar()) return fault(node, " is not a number");
  if (node.quoted && !has_unit) return fault(node, " in quotes is text");
  const Parsed<std::int64_t> parsed = unit_ == Unit::nanoseconds ? plain(parse_duration(node.text))
                                      : unit_ == Unit::bits_per_second
                                          ? plain(parse_rate(node.text))
                                          : parse_count(node.text);
  if (!parsed) return Fault{node.place, parsed.error()};
  if (*parsed < minimum_ || *parsed > maximum_) return fault(node, " is out of range");
  count = *parsed;
  return std::nullopt;
}

std::string NumberType::expected() const {
  const std::string range = fmt::format("from {} to {}", print(minimum_), print(maximum_));
  switch (unit_) {
    case Unit::nanoseconds:
      return "a duration " + range;
    case Unit::bits_per_second:
      return "a rate " + range;
    case Unit::bytes:
      return "a number of bytes " + range;
    case Unit::things:
      return "an integer " + range;
  }
  return {};
}

Complaint SeedType::read(const Node& node, std::uint64_t& value) const {
  if (!node.is_scalar()) return fault(node, " is not a number");
  if (node.quoted) return fault(node, " in quotes is text");
  const std::string& text = node.text;
  std::uint64_t seed = 0;
  const auto [end, failed] = std::from_chars(text.data(), text.data() + text.size(), seed);
  if (failed == std::errc::result_out_of_range) return fault(node, " is too large");
  const bool is_plain = text == "0" || !text.starts_with('0');
  if (failed != std::errc{} || end != text.data() + text.size() || !is_plain) {
    return fault(node, text.starts_with('-') ? " is negative"
                                             : " is not an integer in plain decimal digits");
  }
  value = seed;
  return std::nullopt;
}

std::string SeedType::expected() const {
  return fmt::format("an integer from 0 to {}", std::numeric_limits<std::uint64_t>::max());
}

Complaint BytesOrWordType::read(const Node& node, Bytes& value) const {
  if (node.is_scalar() && node.text == word) {
    value = meaning;
    return std::nullopt;
  }
  return number.read(node, value);
}

std::string BytesOrWordType::expected() const {
  return fmt::format("{}, or {}", number.expected(), word);
}

Parsed<std::size_t> read_choice(const Node& node, const std::vector<std::string>& names) {
  if (!node.is_scalar()) return node.shown() + " is not a word";
  const auto found = std::ranges::find(names, node.text);
  if (found != names.end()) return static_cast<std::size_t>(found - names.begin());
  return fmt::format("{} is not known{}", node.shown(), suggestion(node.text, names));
}

std::string one_of(const std::vector<std::string>& names) {
  return fmt::format("one of {}", fmt::join(names, ", "));
}

Complaint TextType::read(const Node& node, std::string& value) const {
  if (!node.is_scalar()) return fault(node, " is not text");
  if (node.text.empty()) return fault(node, " is empty");
  const auto is_control = [](char c) { return (c >= 0 && c < 0x20) || c == 0x7f; };
  if (std::ranges::any_of(node.text, is_control)) return fault(node, " has control characters");
  value = node.text;
  return std::nullopt;
}

std::string TextType::expected() const { return "text that is not empty, on one line"; }

Complaint TextMapType::read(const Node& node, std::map<std::string, std::string>& value) const {
  if (!node.is_map()) return fault(node, " is not a map");
  value.clear();
  for (const Member& member : node.members) {
    if (auto complaint = TextType{}.read(member.value, value[member.key])) return complaint;
  }
  return std::nullopt;
}

std::string TextMapType::expected() const { return "a map of texts"; }

Complaint RatioType::read(const Node& node, Ratio& value) const {
  if (!node.is_scalar()) return fault(node, " is not a number");
  const auto fraction = parse_fraction(node.text);
  if (!fraction) return Fault{node.place, fraction.error()};
  // The first condition keeps the product of the second within 64 bits.
  if (fraction->denominator > max_denominator ||
      fraction->numerator > maximum * fraction->denominator) {
    return fault(node, fmt::format(" = {} is out of range", print_fraction(*fraction)));
  }
  value = {fraction->numerator, fraction->denominator};
  return std::nullopt;
}

std::string RatioType::expected() const {
  return fmt::format(
      "a decimal or a fraction greater than 0 and at most {}, such as 0.05 or 1/20, with a reduced "
      "denominator of at most {}",
      maximum, max_denominator);
}

Complaint FractionType::read(const Node& node, FractionParts<std::int64_t> value) const {
  Ratio ratio;
  Complaint complaint = RatioType{1, max_denominator}.read(node, ratio);
  if (!complaint) value.numerator = ratio.numerator, value.denominator = ratio.denominator;
  return complaint;
}

Complaint BytesPairType::read(const Node& node, std::array<Bytes, 2>& value) const {
  if (!node.is_sequence()) return fault(node, " is not a list");
  if (node.items.size() != 2) return fault(node, fmt::format(" of {}", node.items.size()));
  if (Complaint complaint = number.read(node.items[0], value[0])) return complaint;
  return number.read(node.items[1], value[1]);
}

std::string BytesPairType::expected() const {
  return fmt::format("[first, last], each {}", number.expected());
}

Complaint DurationRangeType::read(const Node& node, RangeParts<Nanoseconds> value) const {
  if (!node.is_sequence()) return fault(node, " is not a list");
  if (node.items.size() != 2) return fault(node, fmt::format(" of {}", node.items.size()));
  if (Complaint complaint = number.read(node.items[0], value.low)) return complaint;
  if (Complaint complaint = number.read(node.items[1], value.high)) return complaint;
  if (value.low > value.high) {
    return Fault{node.place,
                 fmt::format("{} is more than {}", node.items[0].shown(), node.items[1].shown())};
  }
  return std::nullopt;
}

std::string DurationRangeType::expected() const {
  return fmt::format("[low, high], each {}, the first at most the second", number.expected());
}

Complaint NumberSetType::read(const Node& node, std::vector<std::uint64_t>& value) const {
  if (!node.is_sequence()) return fault(node, " is not a list");
  std::vector<std::uint64_t> numbers(node.items.size());
  for (std::size_t k = 0; k < numbers.size(); ++k) {
    if (Complaint complaint = number.read(node.items[k], numbers[k])) return complaint;
  }
  std::ranges::sort(numbers);
  numbers.erase(std::unique(numbers.begin(), numbers.end()), numbers.end());
  value = std::move(numbers);
  return std::nullopt;
}

std::string NumberSetType::expected() const {
  return fmt::format("a list of numbers, each {}", number.expected());
}

}  // namespace stormproof::model::config
