// Text inside Mermaid diagrams, whose syntax gives a meaning to some characters.
#pragma once

#include <string>
#include <string_view>

namespace stormproof::draw {

/// `text` with `#`, `;`, `<`, `>` and `%` as Mermaid's entity codes and without line feeds.
[[nodiscard]] inline std::string mermaid_text(std::string_view text) {
  std::string result;
  for (const char c : text) {
    switch (c) {
      case '#':
        result += "#35;";
        break;
      case ';':
        result += "#59;";
        break;
      case '<':
        result += "#lt;";
        break;
      case '>':
        result += "#gt;";
        break;
      case '%':
        result += "#37;";
        break;
      case '\n':
        result += ' ';
        break;
      default:
        result += c;
    }
  }
  return result;
}

}  // namespace stormproof::draw
