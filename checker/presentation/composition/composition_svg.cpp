// A composition as one drawing, to be read from the top to the bottom: who there is, how to read a
// rule, then a band for each rule. Widths are fixed, so that the drawing fits a page.
#include <algorithm>

#include <fmt/format.h>

#include "checker/presentation/composition/composition_bands.hpp"
#include "checker/presentation/composition/composition_drawing.hpp"
#include "checker/presentation/composition/composition_graph.hpp"
#include "checker/presentation/composition/composition_overview.hpp"
#include "checker/presentation/composition/composition_pen.hpp"
#include "checker/presentation/composition/composition_words.hpp"
#include "checker/presentation/text/paragraph.hpp"

namespace stormproof::draw {

namespace {

namespace comp = fsm::composition;

constexpr int left_edge = CompositionPen::page_left;
constexpr int right_edge = CompositionPen::page_right;
constexpr int band_gap = 14;

class PagePainter {
 public:
  explicit PagePainter(const comp::CompositionInfo& composition)
      : composition_{composition},
        parties_{parties(composition)},
        svg_{fmt::format("The composition {}", composition.name),
             "Every rule with its trigger and its effects, and where packets and timers lead."},
        pen_{composition, svg_} {}

  std::string run() && {
    svg_.text(left_edge, y_ = 42, fmt::format("The composition '{}'", composition_.name), "title");
    write(
        "Machines do not know each other. What follows is what happens between them: who there "
        "is on which side, then rule by rule.");
    y_ = draw_overview(composition_, parties_, pen_, svg_, y_ + 14);
    explain();
    heading("What happens");
    for (const comp::RuleInfo* rule : reading_order(composition_)) {
      y_ = draw_band(composition_, parties_, *rule, pen_, svg_, y_ + band_gap);
    }
    list("What follows from the state", composition_.facts);
    list("What no rule needs, and why", unused());
    return svg_.finish(right_edge + left_edge, y_ + left_edge,
                       CompositionPen::style() + band_style());
  }

 private:
  void heading(std::string_view title) {
    constexpr int with_what_follows = 100;
    y_ = CompositionPen::on_one_page(y_ + 24, with_what_follows);
    svg_.text(left_edge, y_ + 16, title, "title");
    y_ += 32;
  }
  void write(const std::string& text) {
    const auto columns = CompositionPen::columns(right_edge - left_edge);
    y_ = pen_.lines(left_edge, y_ + 22, report::wrapped(text, columns), "quiet") - 16;
  }

  /// Words in one column, meanings in the next.
  template <class Words>
  void list(std::string_view title, const Words& words) {
    if (words.empty()) return;
    heading(title);
    int width = 200;
    for (const auto& [word, meaning] : words) {
      width = std::max(width, text_width(word, CompositionPen::font_size));
    }
    const int left = left_edge + width + 24;
    for (const auto& [word, meaning] : words) {
      const auto lines = report::wrapped(meaning, CompositionPen::columns(right_edge - left), 2);
      y_ = CompositionPen::on_one_page(
          y_, CompositionPen::line_height * static_cast<int>(lines.size()));
      svg_.text(left_edge, y_ + 12, word, "");
      y_ = pen_.lines(left, y_ + 12, lines, "quiet") - 12;
    }
  }
  [[nodiscard]] Glossary unused() const {
    Glossary glossary;
    for (const comp::UnusedInfo& one : composition_.unused) {
      glossary.emplace_back(fmt::format("{}.{}", one.part, one.name), one.reason);
    }
    return glossary;
  }

  void explain() {
    Glossary words = notation();
    words.emplace_back(".1", fmt::format("the number of an effect; with its rule its id: {}.1",
                                         composition_.rules.front().id));
    list("How to read it", words);
    y_ = CompositionPen::on_one_page(y_ + 8, CompositionPen::chip_height);
    int x = left_edge;
    const auto sample = [&](const auto& things, const char* words) {
      if (things.empty()) return;
      x += pen_.chip(x, y_, things.front().name) + 8;
      svg_.text(x, y_ + 13, words, "quiet");
      x += text_width(words, CompositionPen::font_size) + 24;
    };
    sample(composition_.packets, "a packet");
    sample(composition_.timers, "a timer");
    sample(composition_.occasions, "an occasion");
    svg_.text(x, y_ + 13, "each leads to the rule for it", "quiet");
    y_ += CompositionPen::chip_height;
  }

  const comp::CompositionInfo& composition_;
  const std::vector<Party> parties_;
  Svg svg_;
  CompositionPen pen_;
  int y_ = 0;
};

}  // namespace

std::string composition_svg(const comp::CompositionInfo& composition) {
  return PagePainter{composition}.run();
}

}  // namespace stormproof::draw
