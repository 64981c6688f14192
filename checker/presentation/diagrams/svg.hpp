// Building of SVG documents by hand: escaping, text widths, and a canvas that collects elements.
// Everything is drawn with classes whose colours follow the viewer's light or dark preference, and
// text is set in a monospaced font, so that widths are known without asking a font.
#pragma once

#include <string>
#include <string_view>

namespace stormproof::draw {

/// `text` with &, <, >, " and ' as XML entities, and without characters that XML forbids.
[[nodiscard]] std::string xml_text(std::string_view text);

/// An upper bound of the width of `text` in pixels at this font size; multi-byte characters count
/// as one and a half columns, because fonts may replace them.
[[nodiscard]] int text_width(std::string_view text, int font_size);

/// How a text is placed at its x: SVG's text-anchor.
enum class Anchor { start, middle, end };

class Svg {
 public:
  /// Titles are for those who cannot see the drawing.
  Svg(std::string_view title, std::string_view description);

  void line(int x1, int y1, int x2, int y2, std::string_view classes);
  void rect(int x, int y, int width, int height, std::string_view classes, int radius = 0);
  void circle(int x, int y, int radius, std::string_view classes);
  void path(std::string_view data, std::string_view classes);
  void text(int x, int y, std::string_view text, std::string_view classes,
            Anchor anchor = Anchor::start);
  /// A text that leads to the group of this id.
  void link(int x, int y, std::string_view text, std::string_view classes, std::string_view to,
            Anchor anchor = Anchor::start);

  /// What is drawn until it is closed is a group that links and the style sheet's `:target` find.
  /// Groups may stand in groups.
  void open_group(std::string_view id, std::string_view classes = {});
  void close_group();

  /// The document. `style` is CSS in addition to the common classes.
  [[nodiscard]] std::string finish(int width, int height, std::string_view style = {}) const;

 private:
  std::string title_;
  std::string description_;
  std::string elements_;
};

}  // namespace stormproof::draw
