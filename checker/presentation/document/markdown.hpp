// GitHub's Markdown, for comments on pull requests: texts of users that stay texts, tables, folded
// details, and a length that GitHub accepts.
#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace stormproof::report {

/// GitHub takes 65,536 characters; some are left for those who wrap the report into a comment.
inline constexpr std::size_t markdown_bytes = 60'000;

/// On one line, shown as it is: nothing in it formats, links, mentions a person or is HTML.
[[nodiscard]] std::string md_text(std::string_view text);

/// As `code`, on one line; also good in a cell of a table.
[[nodiscard]] std::string md_code(std::string_view text);

/// A fenced block, whatever backticks the text has.
[[nodiscard]] std::string md_block(std::string_view language, std::string_view text);

/// Cells are Markdown already (`md_text`, `md_code`). `align` has one letter for each column: l, r.
[[nodiscard]] std::string md_table(const std::vector<std::string>& head, std::string_view align,
                                   const std::vector<std::vector<std::string>>& rows);

/// Folded; `summary` is plain text, `body` is Markdown.
[[nodiscard]] std::string md_details(std::string_view summary, std::string_view body);

/// A report that is cut where it gets too long, section by section: a section without room is left
/// out and named at the end.
class MarkdownDocument {
 public:
  /// `name` says what is missing if the section is left out; empty: the section always stays.
  void add(std::string name, std::string text);
  /// At most `limit` bytes if the sections without a name leave room. `elsewhere` says where
  /// everything is.
  [[nodiscard]] std::string text(std::string_view elsewhere,
                                 std::size_t limit = markdown_bytes) const;

 private:
  struct Section {
    std::string name;
    std::string text;
  };
  std::vector<Section> sections_;
};

}  // namespace stormproof::report
