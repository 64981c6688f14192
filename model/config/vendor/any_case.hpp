// Words of vendors' files of which the case does not matter: letters of ASCII, whatever the locale.
#pragma once

#include <algorithm>
#include <string>
#include <string_view>

namespace stormproof::model::config::vendor {

[[nodiscard]] constexpr char lower(char c) {
  return c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c;
}
[[nodiscard]] inline std::string in_lower_case(std::string_view text) {
  std::string word{text};
  std::ranges::transform(word, word.begin(), lower);
  return word;
}
/// Whether `a` and `b` are the same but for the case.
[[nodiscard]] constexpr bool is_same_word(std::string_view a, std::string_view b) {
  return std::ranges::equal(a, b, {}, lower, lower);
}

}  // namespace stormproof::model::config::vendor
