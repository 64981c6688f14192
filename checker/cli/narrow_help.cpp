// Line by line; the parser has put descriptions into columns of their own.
#include "checker/cli/narrow_help.hpp"

#include <sstream>

namespace stormproof::cli {

namespace {

/// Where the parser's descriptions of options begin.
constexpr std::size_t description = 30;

/// Where the rest of a line goes on.
std::size_t indent_of(const std::string& line) {
  const std::size_t first = line.find_first_not_of(' ');
  if (first == 0 || first >= description) return first;
  const bool is_row =
      line[first] == '-' || (line[description - 1] == ' ' && line[description] != ' ');
  return is_row ? description : first;
}

}  // namespace

std::string narrow_help(const std::string& help, std::size_t columns) {
  std::istringstream lines{help};
  std::string narrow;
  for (std::string line; std::getline(lines, line);) {
    const std::size_t first = line.find_first_not_of(' ');
    const bool is_example =
        first != std::string::npos && line.substr(first).starts_with("stormproof ");
    while (line.size() > columns && !is_example) {
      const std::size_t indent = indent_of(line);
      std::size_t blank = line.rfind(' ', columns);
      if (blank == std::string::npos || blank <= indent) {  // a list of words
        blank = line.rfind(',', columns - 1);
        if (blank != std::string::npos) line.insert(++blank, 1, ' ');
      }
      if (blank == std::string::npos || blank <= indent) break;
      narrow += line.substr(0, blank) + '\n';
      line = std::string(indent, ' ') + line.substr(blank + 1);
    }
    narrow += line + '\n';
  }
  if (!help.ends_with('\n') && !narrow.empty()) narrow.pop_back();
  return narrow;
}

}  // namespace stormproof::cli
