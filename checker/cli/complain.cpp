// Messages repeat what a user gave, and that may be a name that somebody else chose: escape codes
// in it reach no terminal.
#include "checker/cli/complain.hpp"

#include <algorithm>

#include <fmt/core.h>

#include "checker/cli/streams.hpp"

namespace stormproof::cli {

std::string visible(std::string_view text) {
  std::string shown;
  for (std::size_t k = 0; k < text.size(); ++k) {
    const auto byte = static_cast<unsigned char>(text[k]);
    const auto next = k + 1 < text.size() ? static_cast<unsigned char>(text[k + 1]) : 0U;
    if ((byte < 0x20 && byte != '\n') || byte == 0x7f) {
      shown += fmt::format("\\x{:02x}", byte);
    } else if (byte == 0xc2 && next >= 0x80 && next < 0xa0) {  // U+0080 to U+009F: control, too
      shown += fmt::format("\\u00{:02x}", next);
      ++k;
    } else {
      shown += text[k];
    }
  }
  return shown;
}

namespace {

/// A word of thousands of characters is nobody's: its ends tell which it is.
std::string with_short_words(const std::string& text) {
  constexpr std::size_t longest = 400;
  constexpr std::size_t kept = 60;
  const auto is_inside = [&](std::size_t k) {  // of a character of several bytes
    return k < text.size() && (static_cast<unsigned char>(text[k]) & 0xC0U) == 0x80U;
  };
  std::string shown;
  for (std::size_t begin = 0; begin < text.size();) {
    std::size_t end = std::min(text.find(' ', begin), text.size());
    if (end - begin > longest) {
      std::size_t head = begin + kept;
      std::size_t tail = end - kept;
      while (is_inside(head)) --head;
      while (is_inside(tail)) ++tail;
      shown += text.substr(begin, head - begin) + "…" + text.substr(tail, end - tail);
    } else {
      shown += text.substr(begin, end - begin);
    }
    if (end < text.size()) shown += text[end++];
    begin = end;
  }
  return shown;
}

}  // namespace

int complain(const std::string& message) {
  say("stormproof: " + with_short_words(visible(message)));
  return bad_input;
}

}  // namespace stormproof::cli
