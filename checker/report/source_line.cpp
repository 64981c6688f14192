// Cuts a line to what fits and counts columns as a person sees them.
#include "checker/report/source_line.hpp"

#include <algorithm>
#include <fstream>
#include <optional>
#include <vector>

#include <fmt/format.h>

namespace stormproof::report {

namespace {

constexpr std::size_t shown_characters = 90;
constexpr std::size_t before_column = 60;  ///< characters of a long line left of its column

bool continues_character(char c) { return (static_cast<unsigned char>(c) & 0xC0U) == 0x80U; }

/// One character a string, without those that would move or colour what is printed.
std::vector<std::string> characters_of(std::string_view line) {
  std::vector<std::string> characters;
  for (const char c : line) {
    const auto byte = static_cast<unsigned char>(c);
    if (continues_character(c) && !characters.empty()) {
      characters.back() += c;
    } else {
      characters.emplace_back(1, byte < 0x20 || byte == 0x7f ? ' ' : c);
    }
  }
  return characters;
}

std::optional<std::string> read_line(const std::string& path, int number) {
  std::ifstream file{path};
  std::string line;
  for (int k = 0; k < number; ++k) {
    if (!std::getline(file, line)) return std::nullopt;
  }
  return line;
}

}  // namespace

std::string marked_line(std::string_view line, int number, int column) {
  const std::size_t bytes =
      std::min(line.size(), static_cast<std::size_t>(std::max(column, 1) - 1));
  const std::vector<std::string> characters = characters_of(line);
  const std::size_t caret = characters_of(line.substr(0, bytes)).size();
  const bool is_long = characters.size() > shown_characters;
  const std::size_t first = is_long && caret > before_column ? caret - before_column : 0;
  const std::size_t last = std::min(characters.size(), first + shown_characters);
  std::string shown = first > 0 ? "…" : "";
  const std::size_t shift = first > 0 ? 1 : 0;
  for (std::size_t k = first; k < last; ++k) shown += characters[k];
  if (last < characters.size()) shown += "…";
  return fmt::format("{:>5} | {}\n      | {}^\n", number, shown,
                     std::string(caret - first + shift, ' '));
}

std::string source_line(const model::config::Place& place) {
  if (!place.source || place.line < 1) return "";
  const auto line = read_line(*place.source, place.line);
  return line ? marked_line(*line, place.line, place.column) : "";
}

}  // namespace stormproof::report
