// Breaking of texts.
#include "checker/presentation/diagrams/wrapped_text.hpp"

#include "checker/presentation/text/paragraph.hpp"

namespace stormproof::draw {

std::vector<std::string> wrapped(std::string_view text, std::size_t width, std::size_t indent) {
  std::vector<std::string> lines;
  std::string line;
  bool at_start = true;
  while (!text.empty()) {
    const std::size_t end = std::min(text.find(' '), text.size());
    const std::string_view word = text.substr(0, end);
    text.remove_prefix(std::min(end + 1, text.size()));
    if (!at_start && report::columns(line) + 1 + report::columns(word) > width) {
      lines.push_back(std::move(line));
      line = std::string(indent, ' ');
      at_start = true;
    }
    if (!at_start) line += ' ';
    line += word;
    at_start = false;
  }
  lines.push_back(std::move(line));
  return lines;
}

}  // namespace stormproof::draw
