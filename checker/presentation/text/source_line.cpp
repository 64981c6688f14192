// Cuts a line to what fits and counts columns as a person sees them.
#include "checker/presentation/text/source_line.hpp"

#include <algorithm>
#include <array>
#include <fstream>

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

/// The part of `line` that can be shown: `column`, a byte from 0, moves with it.
std::string_view near(std::string_view line, std::size_t& column) {
  constexpr std::size_t most = 4 * (shown_characters + 2);  ///< bytes of so many characters
  std::size_t first = column > most ? column - most : 0;
  while (first > 0 && first < line.size() && continues_character(line[first])) --first;
  column -= first;
  return line.substr(std::min(first, line.size()), 2 * most);
}

std::string read_file(const std::string& path) {
  constexpr std::size_t longest = 8 * 1024 * 1024;  ///< of a profile; what follows is not shown
  std::ifstream file{path, std::ios::binary};
  std::string text;
  std::array<char, 65'536> chunk{};
  while (file && text.size() < longest) {
    file.read(chunk.data(), chunk.size());
    text.append(chunk.data(), static_cast<std::size_t>(file.gcount()));
  }
  return text;
}

/// UTF-16, whose lines cannot be printed as they stand.
bool is_wide(std::string_view text) {
  return text.starts_with("\xFE\xFF") || text.starts_with("\xFF\xFE") ||
         text.substr(0, 2).find('\0') != std::string_view::npos;
}

std::vector<std::size_t> line_starts(std::string_view text) {
  std::vector<std::size_t> starts;
  if (text.empty() || is_wide(text)) return starts;
  starts.push_back(text.starts_with("\xEF\xBB\xBF") ? 3 : 0);
  for (std::size_t k = 0; k < text.size(); ++k) {
    const bool is_crlf = text[k] == '\r' && k + 1 < text.size() && text[k + 1] == '\n';
    if (text[k] == '\n' || (text[k] == '\r' && !is_crlf)) starts.push_back(k + 1);
  }
  return starts;
}

}  // namespace

std::string marked_line(std::string_view line, int number, int column) {
  std::size_t bytes = std::min(line.size(), static_cast<std::size_t>(std::max(column, 1) - 1));
  const std::size_t length = line.size();
  const std::size_t column_there = bytes;
  line = near(line, bytes);
  const bool is_cut_before = bytes < column_there;
  const bool is_cut_after = column_there - bytes + line.size() < length;
  const std::vector<std::string> characters = characters_of(line);
  const std::size_t caret = characters_of(line.substr(0, bytes)).size();
  const bool is_long = characters.size() > shown_characters;
  const std::size_t first = is_long && caret > before_column ? caret - before_column : 0;
  const std::size_t last = std::min(characters.size(), first + shown_characters);
  const std::size_t shift = first > 0 || is_cut_before ? 1 : 0;
  std::string shown = shift > 0 ? "…" : "";
  for (std::size_t k = first; k < last; ++k) shown += characters[k];
  if (last < characters.size() || is_cut_after) shown += "…";
  return fmt::format("{:>5} | {}\n      | {}^\n", number, shown,
                     std::string(caret - first + shift, ' '));
}

const SourceLines::Text& SourceLines::text_of(const std::string& path) {
  const auto [at, is_new] = texts_.try_emplace(path);
  if (is_new) {
    at->second.bytes = read_file(path);
    at->second.starts = line_starts(at->second.bytes);
  }
  return at->second;
}

std::string SourceLines::marked(const model::config::Place& place) {
  if (!place.source || place.line < 1) return "";
  const Text& text = text_of(*place.source);
  const auto number = static_cast<std::size_t>(place.line);
  if (number > text.starts.size()) return "";
  const std::size_t start = text.starts[number - 1];
  if (start >= text.bytes.size()) return "";
  const std::size_t end = number < text.starts.size() ? text.starts[number] : text.bytes.size();
  std::string_view line = std::string_view{text.bytes}.substr(start, end - start);
  while (line.ends_with('\n') || line.ends_with('\r')) line.remove_suffix(1);
  return marked_line(line, place.line, place.column);
}

}  // namespace stormproof::report
