// The words of a source text, and its text without comments.
#pragma once

#include <cctype>
#include <string>
#include <string_view>

namespace stormproof::structure {

/// What stands between quotes.
enum class Quoted { left_out, kept };
/// The text without its comments.
[[nodiscard]] std::string code_of(const std::string& text, Quoted quoted = Quoted::left_out);

inline bool is_of_word(char one) {
  return std::isalnum(static_cast<unsigned char>(one)) != 0 || one == '_';
}

/// Calls `visit(word, where it begins)` for each word of the text.
template <class Visit>
void for_words(const std::string& text, Visit&& visit) {
  for (std::size_t at = 0; at < text.size();) {
    if (!is_of_word(text[at])) {
      ++at;
      continue;
    }
    std::size_t end = at;
    while (end < text.size() && is_of_word(text[end])) ++end;
    visit(std::string_view{text}.substr(at, end - at), at);
    at = end;
  }
}

}  // namespace stormproof::structure
