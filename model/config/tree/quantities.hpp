// Durations, rates and counts as they are written in files: decimal numbers with a unit. Parsing is
// exact, in integers: a value that is not a whole number of nanoseconds or bit/s is refused, never
// rounded.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>

#include "model/config/tree/result.hpp"
#include "model/units.hpp"

namespace stormproof::model::config {

/// A parsed value, or what is wrong with the text (it quotes the text).
template <class T>
using Parsed = Result<T, std::string>;

/// A fraction in lowest terms, positive unless it is a share.
struct Fraction {
  std::int64_t numerator = 1;
  std::int64_t denominator = 1;

  [[nodiscard]] double value() const {
    return static_cast<double>(numerator) / static_cast<double>(denominator);
  }

  bool operator==(const Fraction&) const = default;
};

/// "10us", "1.5ms", "3s", and "0" alone. Units: ns, us, ms, s.
[[nodiscard]] Parsed<Nanoseconds> parse_duration(std::string_view text);
/// "144.4Mbps". Units: bps, kbps, Mbps, Gbps.
[[nodiscard]] Parsed<BitsPerSecond> parse_rate(std::string_view text);
/// Decimal digits only, without leading zeros; for byte counts, numbers of things and indices.
[[nodiscard]] Parsed<std::int64_t> parse_count(std::string_view text);
/// A decimal ("0.05") or a fraction ("1/20"), greater than 0; reduced.
[[nodiscard]] Parsed<Fraction> parse_fraction(std::string_view text);

/// A share: "2%", "2 %", "0.02" or "1/50", and "0" or "0%" alone (0/1). At least 0; reduced.
[[nodiscard]] Parsed<Fraction> parse_share(std::string_view text);

/// The shortest exact spelling whose number is at least 1, the larger unit if two are equally
/// short: "100us". `duration` must not be negative. `parse_duration` gives the same value back.
[[nodiscard]] std::string print_duration(Nanoseconds duration);
/// The same for rates: "144.4Mbps".
[[nodiscard]] std::string print_rate(BitsPerSecond rate);
/// "1/20".
[[nodiscard]] std::string print_fraction(const Fraction& fraction);

}  // namespace stormproof::model::config
