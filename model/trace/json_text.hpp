// Printing of JSON by hand. A trace has millions of short lines whose strings are fixed words, so
// building a document for each of them would take most of a run's time. Numbers are integers
// throughout: the same run gives the same bytes with every compiler and library.
#pragma once

#include <charconv>
#include <concepts>
#include <string>
#include <string_view>

#include "model/engine/descriptor_set.hpp"
#include "model/units.hpp"

namespace stormproof::model::trace {

inline void append_part(std::string& out, std::string_view text) { out += text; }

inline void append_part(std::string& out, std::integral auto number) {
  char digits[24];
  const auto end = std::to_chars(std::begin(digits), std::end(digits), number).ptr;
  out.append(std::begin(digits), end);
}

/// Appends texts (as they are) and integers.
template <class... Parts>
void append(std::string& out, const Parts&... parts) {
  (append_part(out, parts), ...);
}

/// Appends "12.345": nanoseconds in microseconds, exactly. Times are not negative.
inline void append_microseconds(std::string& out, Nanoseconds time) {
  const std::int64_t rest = time.count() % 1'000;
  append(out, time.count() / 1'000, rest < 10 ? ".00" : rest < 100 ? ".0" : ".", rest);
}

/// Appends the members of a bitmap, ascending: "[0,3,64]".
void append_members(std::string& out, Words words);
void append_members(std::string& out, const DescriptorSet& set);

/// `text` as a JSON string, with its quotes.
[[nodiscard]] std::string json_string(std::string_view text);

}  // namespace stormproof::model::trace
