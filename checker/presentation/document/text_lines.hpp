// Running text at a terminal: broken into lines, coloured if the terminal has colours, and measured
// in columns, because a table pads what it cannot see.
#pragma once

#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

#include "checker/presentation/document/document.hpp"
#include "checker/presentation/document/render.hpp"

namespace stormproof::report {

struct TextLine {
  std::string shown;        ///< with the sequences that switch colours on and off
  std::size_t columns = 0;  ///< that it takes
};

/// `text` in lines of at most `width` columns, but for words that are longer; at least one line.
[[nodiscard]] std::vector<TextLine> broken(const Text& text, std::size_t width, bool colours);

/// `text` on one line.
[[nodiscard]] TextLine unbroken(const Text& text, bool colours);

/// "✗ violated" of a badge, the text of other spans.
[[nodiscard]] std::string shown_text(const Span& span);

/// `words` in the colour of `tone`, or just bold if that is plain.
[[nodiscard]] std::string emphasised(std::string_view words, Tone tone, bool colours);

/// Lines of a table, each without line feed: as wide as its cells if they fit into `width`;
/// otherwise columns of sentences are broken, and, if the terminal has it so, the last columns left
/// out and named; where even that leaves no room, cells stand below each other. Rows of the result
/// are those of the table, the first one is its head.
[[nodiscard]] std::vector<std::vector<std::string>> table_lines(const Table& table,
                                                                std::size_t width,
                                                                const Terminal& terminal);

}  // namespace stormproof::report
