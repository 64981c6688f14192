// How the names of a composition are drawn, wherever they stand: each packet and timer has one
// shape and colour, and leads to the rule that handles it.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "checker/presentation/diagrams/svg.hpp"
#include "fsm/composition/composition_info.hpp"

namespace stormproof::draw {

class CompositionPen {
 public:
  static constexpr int page_left = 24;
  static constexpr int page_right = 1052;
  static constexpr int font_size = 12;
  static constexpr int small_size = 11;
  static constexpr int line_height = 16;
  static constexpr int small_line = 14;
  static constexpr int chip_height = 18;

  CompositionPen(const fsm::composition::CompositionInfo& composition, Svg& svg)
      : composition_{composition}, svg_{svg} {}

  /// A packet (filled), timer (round) or occasion (dashed), with its left upper corner there.
  /// Returns its width.
  int chip(int x, int y, std::string_view name);
  [[nodiscard]] static int chip_width(std::string_view name);

  /// `before`, then the names of rules as links, in small lines of at most `width`. `y` is the
  /// first baseline; returns the one after the last.
  int links(int x, int y, int width, std::string_view before,
            const std::vector<std::string>& names);

  /// The texts, one below the other, from this baseline on; returns the one after the last.
  int lines(int x, int y, const std::vector<std::string>& texts, std::string_view classes);

  /// `y`, or where the next printed page begins, if `height` pixels from `y` on would be cut by the
  /// end of the page: A4 landscape in its own size, see `style`.
  [[nodiscard]] static int on_one_page(int y, int height);

  /// Columns of text of `size` pixels that `width` pixels hold.
  [[nodiscard]] static std::size_t columns(int width, int size = font_size);

  /// The id of a rule or effect as XML allows it: "Deliver-ToAll.3".
  [[nodiscard]] static std::string element_id(std::string_view id);

  /// What the drawing's style sheet needs for all this.
  [[nodiscard]] static std::string style();

 private:
  const fsm::composition::CompositionInfo& composition_;
  Svg& svg_;
};

}  // namespace stormproof::draw
