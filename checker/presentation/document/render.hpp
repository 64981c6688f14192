// The formats in which a document is shown.
#pragma once

#include <cstddef>
#include <string>

#include <nlohmann/json_fwd.hpp>

#include "checker/presentation/document/document.hpp"

namespace stormproof::report {

/// What a terminal can show. A pipe has no colours and 100 columns.
struct Terminal {
  std::size_t columns = 100;  ///< text is broken to fit; at least 60, at most 120
  bool colours = false;
  bool verbose = false;  ///< shows blocks for `Audience::verbose`
  /// Leaves columns of a table out, and names them, rather than break its lines. A pipe has all.
  bool drops_columns = false;
};

/// For a person at a terminal: the answer, the blocks, assumptions, the command.
[[nodiscard]] std::string to_text(const Document& document, const Terminal& terminal = {});

/// GitHub's Markdown, for a comment on a pull request: at most `markdown_bytes`; sections without
/// room are left out and named at the end.
[[nodiscard]] std::string to_markdown(const Document& document);

/// The same with what is for comments alone, and a first line that nobody sees, by which a
/// workflow finds the comment that it renews: "<!-- stormproof diff -->", of `verb`.
[[nodiscard]] std::string to_comment(Document document, const std::string& verb);

/// One self-contained page.
[[nodiscard]] std::string to_html(const Document& document);

/// JUnit XML: one test case for each finding that is no note.
[[nodiscard]] std::string to_junit(const Document& document);

/// SARIF 2.1.0: the findings with their rules. Columns become characters if the file can be read;
/// paths below the current folder become relative to it.
[[nodiscard]] nlohmann::ordered_json to_sarif(const Document& document);

/// "file name.xml" → "file%20name.xml"; absolute paths outside of the current folder as file:///….
[[nodiscard]] std::string uri_of(const std::string& path);

}  // namespace stormproof::report
