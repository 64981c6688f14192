// How reports write numbers for people: grouped digits, times with a fitting unit, ratios.
#pragma once

#include <cstdint>
#include <string>

#include "model/units.hpp"

namespace stormproof::report {

/// 18106 → "18,106".
[[nodiscard]] std::string grouped(std::uint64_t value);

/// Four significant digits with the unit that fits: "6.263 s", "16.14 ms", "100 µs".
[[nodiscard]] std::string duration(model::Nanoseconds value);

/// value / reference with "×", three significant digits; "–" if the reference is 0.
[[nodiscard]] std::string ratio(double value, double reference);

/// part / whole in percent with one decimal: "99.7 %".
[[nodiscard]] std::string percent(double part, double whole);

/// A bar of blocks, `longest` of them if `share` is 1; at least one if it is more than 0.
[[nodiscard]] std::string bar(double share, std::size_t longest);

/// `text` padded on the left to `width` columns; multi-byte characters count as one column.
[[nodiscard]] std::string right(const std::string& text, std::size_t width);
/// The same, padded on the right.
[[nodiscard]] std::string left(const std::string& text, std::size_t width);

}  // namespace stormproof::report
