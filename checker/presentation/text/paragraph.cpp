// Breaking of paragraphs.
#include "checker/presentation/text/paragraph.hpp"

#include <algorithm>

namespace stormproof::report {

std::size_t columns(std::string_view text) {
  return static_cast<std::size_t>(std::count_if(text.begin(), text.end(), [](char c) {
    return (static_cast<unsigned char>(c) & 0xC0U) != 0x80U;
  }));
}

std::vector<std::string> wrapped(std::string_view text, std::size_t width, std::size_t indent,
                                 std::string_view first) {
  std::vector<std::string> lines{std::string{first}};
  std::size_t start = columns(first);
  std::size_t used = start;
  while (!text.empty()) {
    const std::size_t end = std::min(text.find(' '), text.size());
    const std::string_view word = text.substr(0, end);
    text.remove_prefix(std::min(end + 1, text.size()));
    if (used > start && used + 1 + columns(word) > width) {
      lines.emplace_back(indent, ' ');
      start = used = indent;
    } else if (used > start) {
      lines.back() += ' ';
      ++used;
    }
    lines.back() += word;
    used += columns(word);
  }
  return lines;
}

std::string paragraph(std::string_view first, std::string_view text, std::size_t width) {
  std::string out;
  for (const std::string& line : wrapped(text, width, columns(first), first)) out += line + "\n";
  return out;
}

}  // namespace stormproof::report
