// Values of Cyclone DDS's configuration, read as version 0.10 reads them: numbers with a unit, and
// words of which the case does not matter. A duration without a unit is refused although the
// library still takes some as milliseconds: its manual asks for the unit, and what is meant by "10"
// is a guess.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>

#include "model/config/tree/quantities.hpp"

namespace stormproof::model::config::vendor {

enum class CycloneKind : std::uint8_t {
  text,
  boolean,
  integer,
  size,
  duration,
  choice,  ///< one of `words`
  choices  ///< a list of `words` with commas between
};

struct CycloneType {
  CycloneKind kind = CycloneKind::text;
  std::int64_t minimum = 0, maximum = 0;  ///< of a number, in ns or bytes
  std::string_view words = {};  ///< "false,spdp,…": of a choice; of a number, words instead of it
};

struct CycloneValue {
  std::int64_t number = 0;  ///< ns, bytes or plain; 0 or 1 of a boolean
  std::string word;         ///< of a choice, in lower case, or instead of a number ("inf")
  bool lacks_unit = false;  ///< a size that the library takes as bytes
};

/// Longest finite duration of the library, 2^63 - 2 ns, and its largest size.
inline constexpr std::int64_t cyclone_longest_ns = 9'223'372'036'854'775'806;
inline constexpr std::int64_t cyclone_largest_bytes = 2'147'483'647;

/// "a duration with its unit (ns, us, …) from 0 s to 1 hr", "one of false, true".
[[nodiscard]] std::string expectation(const CycloneType& type);

/// What is wrong quotes the text, and does not say what was expected.
[[nodiscard]] Parsed<CycloneValue> parse_cyclone(const CycloneType& type, std::string_view text);

/// "100 ms", in the largest unit that makes the number whole: the library reads decimals through
/// floating point.
[[nodiscard]] std::string print_cyclone_duration(std::int64_t nanoseconds);

}  // namespace stormproof::model::config::vendor
