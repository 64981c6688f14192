// The kinds of value a knob can have: number with a range, choice, text, fraction, and a few lists.
// Each kind knows how to read itself from a tree and how to describe itself in an error; the knob
// tables combine them with keys and ranges.
//
// Every kind has
//   read(node, value)  fills `value`, or returns what is wrong with the node
//   expected()         completes "expected …"
// and, in model/config/knobs/value_json.hpp, the way back to JSON and its schema.
#pragma once

#include <array>
#include <concepts>
#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "model/config/tree/quantities.hpp"
#include "model/config/tree/tree.hpp"
#include "model/limits.hpp"
#include "model/units.hpp"

namespace stormproof::model::config {

/// What is wrong with a value ("'5' has no unit"), and where.
struct Fault {
  Place place;
  std::string reason;
};
using Complaint = std::optional<Fault>;

/// An integer amount in a range: of nanoseconds, bit/s, bytes, or things.
class NumberType {
 public:
  enum class Unit { nanoseconds, bits_per_second, bytes, things };

  constexpr NumberType(Unit unit, std::int64_t minimum, std::int64_t maximum)
      : unit_{unit}, minimum_{minimum}, maximum_{maximum} {}

  template <class Tag>
  Complaint read(const Node& node, Quantity<Tag>& value) const {
    std::int64_t count = 0;
    Complaint complaint = read_count(node, count);
    if (!complaint) value = Quantity<Tag>{count};
    return complaint;
  }
  template <std::integral Integer>
  Complaint read(const Node& node, Integer& value) const {
    std::int64_t count = 0;
    Complaint complaint = read_count(node, count);
    if (!complaint) value = static_cast<Integer>(count);
    return complaint;
  }
  std::string expected() const;
  /// `count` as a file would say it.
  std::string print(std::int64_t count) const;

  constexpr Unit unit() const { return unit_; }
  constexpr std::int64_t minimum() const { return minimum_; }
  constexpr std::int64_t maximum() const { return maximum_; }
  constexpr bool contains(std::int64_t count) const {
    return count >= minimum_ && count <= maximum_;
  }

 private:
  Complaint read_count(const Node& node, std::int64_t& count) const;

  Unit unit_;
  std::int64_t minimum_, maximum_;
};

inline constexpr std::int64_t second_ns = 1'000'000'000;
/// Longest duration in a file, 10^6 s; products of two quantities of a run then stay within 64
/// bits.
inline constexpr std::int64_t max_duration_ns = 1'000'000 * second_ns;

/// A duration that may be zero.
inline constexpr NumberType delay_range{NumberType::Unit::nanoseconds, 0, max_duration_ns};
/// The period of a timer that schedules itself again: zero would stop the clock.
inline constexpr NumberType period_range{NumberType::Unit::nanoseconds, 1, max_duration_ns};
/// 1 bit/s to 1 Pbit/s.
inline constexpr NumberType rate_range{NumberType::Unit::bits_per_second, 1, 1'000'000'000'000'000};
constexpr NumberType byte_range(std::int64_t minimum, std::int64_t maximum) {
  return {NumberType::Unit::bytes, minimum, maximum};
}
constexpr NumberType count_range(std::int64_t minimum, std::int64_t maximum) {
  return {NumberType::Unit::things, minimum, maximum};
}

/// A number that is written only if it is not the usual one.
struct UsualNumberType : NumberType {
  std::int64_t usual = 0;
};
constexpr UsualNumberType usually(NumberType type, std::int64_t usual) { return {type, usual}; }

/// Any unsigned 64-bit integer.
struct SeedType {
  Complaint read(const Node& node, std::uint64_t& value) const;
  std::string expected() const;
};

/// Bytes, or a word that stands for one special value.
struct BytesOrWordType {
  NumberType number;
  std::string_view word;
  Bytes meaning;

  Complaint read(const Node& node, Bytes& value) const;
  std::string expected() const;
};

/// The enumerators' names in a file, in the order of their values. Specialised beside the table
/// that uses them.
template <class Enum>
inline constexpr std::array<std::string_view, 0> enum_names{};

/// The name of an enumerator, as a file spells it.
template <class Enum>
requires std::is_enum_v<Enum>
[[nodiscard]] constexpr std::string_view name_of(Enum value) {
  return enum_names<Enum>[static_cast<std::size_t>(value)];
}

/// Number of the name in `names` that `node` holds.
Parsed<std::size_t> read_choice(const Node& node, const std::vector<std::string>& names);
std::string one_of(const std::vector<std::string>& names);

template <class Enum>
struct ChoiceType {
  static std::vector<std::string> names() {
    return {enum_names<Enum>.begin(), enum_names<Enum>.end()};
  }
  Complaint read(const Node& node, Enum& value) const {
    const auto chosen = read_choice(node, names());
    if (!chosen) return Fault{node.place, chosen.error()};
    value = static_cast<Enum>(*chosen);
    return std::nullopt;
  }
  std::string expected() const { return one_of(names()); }
};

/// A choice that is written only if it is not the usual one.
template <class Enum>
struct UsualChoiceType : ChoiceType<Enum> {
  Enum usual{};
};

/// Text that is not empty.
struct TextType {
  Complaint read(const Node& node, std::string& value) const;
  std::string expected() const;
};

/// A map of texts with free keys; written only if it is not empty.
struct TextMapType {
  Complaint read(const Node& node, std::map<std::string, std::string>& value) const;
  std::string expected() const;
};

/// A decimal or fraction, greater than 0 and at most `maximum`, whose reduced denominator is at
/// most `max_denominator`.
struct RatioType {
  std::int64_t maximum;
  std::int64_t max_denominator = 1'000'000;

  Complaint read(const Node& node, Ratio& value) const;
  std::string expected() const;
};

/// The two members of a profile that hold one fraction.
template <class Integer>
struct FractionParts {
  Integer& numerator;
  Integer& denominator;
};
template <class Integer>
FractionParts(Integer&, Integer&)
    -> FractionParts<Integer>;  // clang 14 does not deduce it by itself

/// A decimal or fraction, greater than 0 and at most 1, whose reduced denominator is at most
/// `max_denominator`.
struct FractionType {
  std::int64_t max_denominator;

  Complaint read(const Node& node, FractionParts<std::int64_t> value) const;
  std::string expected() const { return RatioType{1, max_denominator}.expected(); }
};

/// `[first, last]`, two byte counts.
struct BytesPairType {
  NumberType number;

  Complaint read(const Node& node, std::array<Bytes, 2>& value) const;
  std::string expected() const;
};

/// The two members of a struct that hold one range.
template <class Duration>
struct RangeParts {
  Duration& low;
  Duration& high;
};
template <class Duration>
RangeParts(Duration&, Duration&) -> RangeParts<Duration>;

/// `[low, high]`, two durations, the first at most the second.
struct DurationRangeType {
  NumberType number;

  Complaint read(const Node& node, RangeParts<Nanoseconds> value) const;
  std::string expected() const;
};

/// A list of integers, sorted and without duplicates once it is read.
struct NumberSetType {
  NumberType number;

  Complaint read(const Node& node, std::vector<std::uint64_t>& value) const;
  std::string expected() const;
};
/// One that is written only if it is not empty.
struct SomeNumbersType : NumberSetType {};

}  // namespace stormproof::model::config
