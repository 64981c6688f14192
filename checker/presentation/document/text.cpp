// A document at a terminal: the answer first, then the blocks one below the other, what is folded
// elsewhere at the end, and the command that repeats it.
#include <algorithm>
#include <type_traits>

#include <fmt/core.h>

#include "checker/presentation/document/render.hpp"
#include "checker/presentation/document/text_lines.hpp"
#include "checker/presentation/text/numbers.hpp"
#include "checker/presentation/text/paragraph.hpp"
#include "checker/presentation/text/plain_text.hpp"

namespace stormproof::report {

namespace {

class TextPage {
 public:
  explicit TextPage(const Terminal& terminal)
      : terminal_{terminal},
        width_{std::clamp<std::size_t>(terminal.columns, 60, 120)},
        colours_{terminal.colours},
        verbose_{terminal.verbose} {}

  std::string run(const Document& document) && {
    answer(document);
    blocks(document.blocks, 0);
    if (!document.assumptions.empty()) {
      add(Section{"Assumptions", "", {Bullets{document.assumptions}}}, 0);
    }
    if (!left_out_.empty()) {
      blank_line();
      running(0, "with -v: ", Text{fmt::format("{}", fmt::join(left_out_, ", "))});
    }
    if (!document.command.empty()) {
      add(Section{"Repeat it", "", {Command{document.command}}}, 0);
    }
    if (!document.next.empty()) blank_line();
    for (const NextStep& step : document.next) {
      line(0, fmt::format("next: {}", valid_text(step.command)));
      running(0, "      ", step.why);
    }
    return std::move(out_);
  }

 private:
  void line(std::size_t indent, std::string_view text) {
    while (text.ends_with(' ')) text.remove_suffix(1);
    if (!text.empty()) out_ += std::string(indent, ' ') + std::string{text};
    out_ += '\n';
  }

  void blank_line() {
    if (!out_.empty() && !out_.ends_with("\n\n")) out_ += '\n';
  }

  /// `first` stands before the first line; the others are indented as far.
  void running(std::size_t indent, std::string_view first, const Text& text) {
    const std::size_t used = indent + columns(first);
    std::string_view before = first;
    const std::string others(columns(first), ' ');
    for (const TextLine& part : broken(text, width_ - std::min(width_ - 20, used), colours_)) {
      line(indent, std::string{before} + part.shown);
      before = others;
    }
  }

  void lines_of(std::size_t indent, const std::string& text) {
    std::string_view rest = text;
    while (!rest.empty()) {
      const std::size_t end = std::min(rest.find('\n'), rest.size());
      line(indent, rest.substr(0, end));
      rest.remove_prefix(std::min(end + 1, rest.size()));
    }
  }

  void answer(const Document& document) {
    const std::string_view sign = sign_of(document.tone);
    if (!document.answer.empty()) {
      const std::string words = (sign.empty() ? "" : std::string{sign} + " ") +
                                one_line(plain_with_signs(document.answer));
      for (const TextLine& part : broken(Text{words}, width_, false)) {
        line(0, emphasised(part.shown, document.tone, colours_));
      }
    }
    if (!document.elaboration.empty()) running(0, "", document.elaboration);
    if (!document.subject.empty()) {
      blank_line();
      running(0, "", document.subject);
    }
  }

  static std::string plain_with_signs(const Text& text) {
    std::string words;
    for (const Span& span : text.spans()) words += shown_text(span);
    return words;
  }

  [[nodiscard]] bool sees(Audience audience) const {
    switch (audience) {
      case Audience::everybody:
      case Audience::terminal:
        return true;
      case Audience::verbose:
      case Audience::explained:
        return verbose_;
      case Audience::documents:
      case Audience::comment:
      case Audience::page:
        break;
    }
    return false;
  }

  [[nodiscard]] bool is_shown(const Block& block) const {
    if (!sees(block.audience) || std::holds_alternative<Drawing>(block.content)) return false;
    const auto* section = std::get_if<Section>(&block.content);
    return section == nullptr || std::ranges::any_of(section->blocks, [&](const Block& inner) {
             return is_shown(inner);
           });
  }

  static bool is_folded(const Block& block) {
    const auto* section = std::get_if<Section>(&block.content);
    return section != nullptr && section->folded;
  }

  /// What -v would show, under its title.
  void leave_out(const Block& block) {
    if (block.audience != Audience::verbose && block.audience != Audience::explained) return;
    const auto* section = std::get_if<Section>(&block.content);
    if (section != nullptr && !section->title.empty()) left_out_.push_back(section->title);
  }

  /// Without blank lines between them if `dense`.
  void blocks(const Blocks& all, std::size_t indent, bool dense = false) {
    for (const bool folded : {false, true}) {
      for (const Block& block : all) {
        if (is_folded(block) != folded) continue;
        if (!sees(block.audience)) leave_out(block);
        if (!is_shown(block)) continue;
        if (!dense) blank_line();
        std::visit([&](const auto& content) { add(content, indent); }, block.content);
      }
    }
  }

  void add(const Paragraph& block, std::size_t indent) {
    const std::string_view sign = sign_of(block.tone);
    running(indent, sign.empty() ? "" : std::string{sign} + " ", block.text);
  }

  void add(const Bullets& block, std::size_t indent) {
    for (const Text& item : block.items) running(indent, "- ", item);
  }

  void add(const Facts& block, std::size_t indent) {
    std::size_t widest = 0;
    for (const auto& [label, text] : block.rows) widest = std::max(widest, columns(label));
    for (const auto& [label, text] : block.rows) {
      running(indent, left(one_line(label), widest + 2), text);
    }
  }

  void add(const Table& block, std::size_t indent) {
    if (!block.caption.empty()) running(indent, "", block.caption);
    const auto rows = table_lines(block, width_ - indent, terminal_);
    for (const std::string& text : rows.front()) line(indent, text);
    for (std::size_t k = 0; k < block.rows.size(); ++k) {
      for (const std::string& text : rows[k + 1]) line(indent, text);
      blocks(block.rows[k].details, indent + 4, true);
    }
  }

  void add(const Listing& block, std::size_t indent) { lines_of(indent, valid_text(block.text)); }

  void add(const Command& block, std::size_t indent) { lines_of(indent, valid_text(block.line)); }

  void add(const Drawing& /*block*/, std::size_t /*indent*/) {}

  /// Stories and charts have a layout of their own; charts are as wide as a report.
  void add(const Sequence& block, std::size_t indent) {
    if (block.story) {
      lines_of(0, valid_text(block.story(width_)));
      return;
    }
    if (!block.caption.empty()) running(indent, "", block.caption);
    lines_of(0, valid_text(sequence::text_chart(block.chart)));
  }

  void add(const Later& block, std::size_t indent) { blocks(block.make(), indent); }

  void add(const Section& block, std::size_t indent) {
    if (block.title.empty()) {
      blocks(block.blocks, indent);
      return;
    }
    blank_line();
    for (const TextLine& part : broken(Text{block.title}, width_ - indent, false)) {
      line(indent, emphasised(part.shown, Tone::plain, colours_));
    }
    const std::size_t before = out_.size();
    blocks(block.blocks, indent + 2);
    if (before < out_.size() && out_[before] == '\n') out_.erase(before, 1);
  }

  std::string out_;
  Terminal terminal_;
  std::size_t width_;
  bool colours_;
  bool verbose_;
  std::vector<std::string> left_out_{};  ///< titles of what only -v shows
};

}  // namespace

std::string to_text(const Document& document, const Terminal& terminal) {
  return TextPage{terminal}.run(document);
}

}  // namespace stormproof::report
