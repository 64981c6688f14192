// A document as a comment on a pull request: short parts open, long ones folded. What the reader
// can do without is left out, part by part, where the comment gets too long.
#include "checker/presentation/document/markdown.hpp"

#include <algorithm>

#include <fmt/core.h>

#include "checker/presentation/document/render.hpp"
#include "checker/presentation/text/paragraph.hpp"
#include "checker/presentation/text/plain_text.hpp"

namespace stormproof::report {

namespace {

std::string_view emoji_of(Tone tone) {
  switch (tone) {
    case Tone::good:
      return "✅";
    case Tone::info:
      return "ℹ️";
    case Tone::warn:
      return "❔";
    case Tone::bad:
      return "❌";
    case Tone::plain:
      break;
  }
  return "";
}

/// `escaped` with the blanks around it that `text` has; Markdown joins what follows each other.
std::string with_blanks(std::string_view text, const std::string& escaped) {
  const auto is_blank = [](char c) { return c == ' ' || c == '\n' || c == '\t'; };
  if (text.empty()) return "";
  if (escaped.empty()) return " ";
  return (is_blank(text.front()) ? " " : "") + escaped + (is_blank(text.back()) ? " " : "");
}

std::string md_span(const Span& span) {
  switch (span.kind) {
    case Span::Kind::code:
      return md_code(span.text);
    case Span::Kind::strong:
      return "**" + md_text(span.text) + "**";
    case Span::Kind::badge: {
      const std::string_view sign = span.sign.empty() ? emoji_of(span.tone) : span.sign;
      return sign.empty() ? md_text(span.text) : fmt::format("{} {}", sign, md_text(span.text));
    }
    case Span::Kind::plain:
    case Span::Kind::link:
      break;
  }
  return with_blanks(span.text, md_text(span.text));
}

std::string md(const Text& text) {
  std::string result;
  for (const Span& span : text.spans()) result += md_span(span);
  return result;
}

bool md_sees(Audience audience) {
  return audience == Audience::everybody || audience == Audience::documents ||
         audience == Audience::verbose;
}

bool md_shown(const Block& block) {
  if (!md_sees(block.audience) || std::holds_alternative<Drawing>(block.content)) return false;
  const auto* section = std::get_if<Section>(&block.content);
  return section == nullptr || std::ranges::any_of(section->blocks, md_shown);
}

std::string to_md(const Blocks& blocks, std::size_t level);

std::string to_md(const Paragraph& block, std::size_t /*level*/) {
  const std::string_view sign = emoji_of(block.tone);
  return (sign.empty() ? "" : std::string{sign} + " ") + md(block.text) + "\n";
}

std::string to_md(const Bullets& block, std::size_t /*level*/) {
  std::string text;
  for (const Text& item : block.items) text += "* " + md(item) + "\n";
  return text;
}

std::string to_md(const Facts& block, std::size_t /*level*/) {
  std::string text;
  for (const auto& [label, value] : block.rows) {
    text += fmt::format("* {}: {}\n", md_text(label), md(value));
  }
  return text;
}

/// The details of rows, folded, under their first two cells.
std::string row_details(const Table& block, const std::string& summary, std::size_t level) {
  std::string text;
  for (const Table::Row& row : block.rows) {
    const std::string details = to_md(row.details, level);
    if (details.empty()) continue;
    std::string name;
    for (std::size_t k = 0; k < std::min<std::size_t>(row.cells.size(), 2); ++k) {
      name += (k == 0 ? "" : " ") + md(row.cells[k]);
    }
    text += (text.empty() ? "" : "\n") + name + "\n\n" + details;
  }
  return text.empty() ? text : md_details(summary, text);
}

/// Without the details of its rows, which are a part of their own.
std::string to_md(const Table& block, std::size_t /*level*/) {
  std::vector<std::size_t> shown;
  std::vector<std::string> head;
  std::string align;
  for (std::size_t k = 0; k < block.columns.size(); ++k) {
    const Column& column = block.columns[k];
    if (column.audience != Audience::everybody && column.audience != Audience::documents) continue;
    shown.push_back(k);
    head.push_back(md_text(column.head));
    align += column.align == Column::Align::right ? 'r' : 'l';
  }
  std::vector<std::vector<std::string>> rows;
  for (const Table::Row& row : block.rows) {
    std::vector<std::string>& cells = rows.emplace_back();
    for (const std::size_t k : shown) cells.push_back(k < row.cells.size() ? md(row.cells[k]) : "");
  }
  const std::string caption = block.caption.empty() ? "" : md_text(block.caption) + "\n\n";
  return caption + md_table(head, align, rows);
}

std::string to_md(const Listing& block, std::size_t /*level*/) {
  return md_block(block.language, block.text);
}

std::string to_md(const Command& block, std::size_t /*level*/) {
  return md_block("sh", block.line);
}

std::string to_md(const Drawing& /*block*/, std::size_t /*level*/) { return {}; }

std::string chart_md(const Sequence& block) {
  return md_details(block.caption.empty() ? "Sequence chart" : block.caption,
                    md_block("mermaid", sequence::mermaid_chart(block.chart)));
}

std::string story_md(const Sequence& block) {
  if (!block.story) return {};
  const std::string name = block.caption.empty() ? "Story" : block.caption + ", as a story";
  return md_details(name, md_block("text", block.story(report_width)));
}

std::string to_md(const Sequence& block, std::size_t /*level*/) {
  return chart_md(block) + "\n" + story_md(block);
}

std::string to_md(const Later& block, std::size_t level) { return to_md(block.make(), level); }

std::string heading(const Section& block, std::size_t level) {
  return std::string(std::min<std::size_t>(level, 6), '#') + " " + md_text(block.title) + "\n";
}

bool is_folded(const Section& block) { return block.folded || block.folded_in_comments; }

std::string to_md(const Section& block, std::size_t level) {
  if (block.title.empty()) return to_md(block.blocks, level);
  const std::string inner = to_md(block.blocks, level + 1);
  if (is_folded(block)) return md_details(block.title, inner);
  return heading(block, level) + "\n" + inner;
}

std::string to_md(const Block& block, std::size_t level) {
  return std::visit([&](const auto& content) { return to_md(content, level); }, block.content);
}

std::string to_md(const Blocks& blocks, std::size_t level) {
  std::string text;
  for (const Block& block : blocks) {
    if (md_shown(block)) text += (text.empty() ? "" : "\n") + to_md(block, level);
  }
  return text;
}

/// The document in parts that may be left out one by one.
class Parts {
 public:
  void add(const Blocks& blocks, const std::string& name, std::size_t level) {
    for (const Block& block : blocks) {
      if (md_shown(block)) add(block, name, level);
    }
  }

  void add(const std::string& name, std::string text) { document_.add(name, std::move(text)); }

  [[nodiscard]] std::string text() const {
    return document_.text("The HTML report shows everything.");
  }

 private:
  void add(const Block& block, const std::string& name, std::size_t level) {
    if (const auto* section = std::get_if<Section>(&block.content)) {
      add(*section, block.audience == Audience::verbose, name, level);
    } else if (const auto* sequence = std::get_if<Sequence>(&block.content)) {
      const std::string chart = sequence->caption.empty() ? "a sequence chart" : sequence->caption;
      document_.add(chart, chart_md(*sequence));
      document_.add(chart, story_md(*sequence));
    } else if (const auto* later = std::get_if<Later>(&block.content)) {
      add(later->make(), name, level);
    } else if (block.audience == Audience::verbose) {
      document_.add(name.empty() ? "details" : name, md_details("Details", to_md(block, level)));
    } else {
      document_.add(name.empty() ? name_of(block) : name, to_md(block, level));
      add_details(block, name.empty() ? "Rows" : name, level);
    }
  }

  void add(const Section& section, bool verbose, const std::string& name, std::size_t level) {
    if (section.title.empty() && verbose) {
      document_.add("details", md_details("Details", to_md(section.blocks, level)));
    } else if (section.title.empty()) {
      add(section.blocks, name, level);
    } else if (verbose || is_folded(section)) {
      document_.add(section.title, md_details(section.title, to_md(section.blocks, level + 1)));
      for (const Block& inner : section.blocks) add_details(inner, section.title, level);
    } else {
      document_.add(section.title, heading(section, level));
      add(section.blocks, section.title, level + 1);
    }
  }

  /// The details of a table's rows: left out before the table is.
  void add_details(const Block& block, const std::string& of, std::size_t level) {
    const auto* table = std::get_if<Table>(&block.content);
    if (table == nullptr || !md_shown(block)) return;
    const std::string name = of + ": details";
    document_.add(name, row_details(*table, name, level));
  }

  /// Of what may be left out; short blocks outside of sections always stay.
  static std::string name_of(const Block& block) {
    if (const auto* table = std::get_if<Table>(&block.content)) {
      return table->caption.empty() ? "a table" : table->caption;
    }
    return std::holds_alternative<Listing>(block.content) ? "a listing" : "";
  }

  MarkdownDocument document_;
};

std::string repeat(const std::string& command) {
  if (command.find('\n') != std::string::npos) {
    return "Repeat it:\n\n" + md_block("sh", command);
  }
  return fmt::format("Repeat it: {}\n", md_code(command));
}

}  // namespace

std::string to_markdown(const Document& document) {
  Parts parts;
  const std::string_view sign = emoji_of(document.tone);
  std::string answer = (sign.empty() ? "" : std::string{sign} + " ") + md(document.answer);
  const std::string title = md_text(document.title);
  parts.add("", "### " + title + (title.empty() || answer.empty() ? "" : ": ") + answer + "\n");
  if (!document.elaboration.empty()) parts.add("", md(document.elaboration) + "\n");
  if (!document.subject.empty()) parts.add("", md(document.subject) + "\n");
  parts.add(document.blocks, "", 4);
  if (!document.assumptions.empty()) {
    parts.add("the assumptions",
              md_details("Assumptions", to_md(Bullets{document.assumptions}, 4)));
  }
  if (!document.command.empty()) parts.add("the command", repeat(document.command));
  for (const NextStep& step : document.next) {
    parts.add("what to do next",
              fmt::format("Next: {} – {}\n", md_code(step.command), md_text(step.why)));
  }
  return parts.text();
}

std::string to_comment(Document document, const std::string& verb) {
  for (Block& block : document.blocks) {
    if (block.audience == Audience::comment) block.audience = Audience::documents;
  }
  return fmt::format("<!-- stormproof {} -->\n{}", verb, to_markdown(document));
}

}  // namespace stormproof::report
