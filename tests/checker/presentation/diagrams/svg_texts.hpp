// Reads the texts of an SVG document with their places, to see what a viewer would: whether the
// document is well-formed XML at all, what it says, and whether texts overlap.
#pragma once

#include <optional>
#include <string>
#include <vector>

namespace stormproof::draw {

/// A text with the box that it takes at most, in pixels.
struct PlacedText {
  std::string text;
  std::string classes;
  int left = 0;
  int right = 0;
  int top = 0;
  int bottom = 0;
};

struct SvgTexts {
  int width = 0;  ///< of the document
  int height = 0;
  std::vector<PlacedText> texts;
  std::vector<std::string> groups;  ///< their ids
  std::vector<std::string> links;   ///< "#id"

  [[nodiscard]] bool says(const std::string& text) const;
  /// How many texts are exactly this.
  [[nodiscard]] std::size_t count(const std::string& text) const;
  /// The texts with this class, joined by spaces.
  [[nodiscard]] std::string joined(const std::string& text_class) const;
  /// "'a' and 'b' overlap" or "'a' leaves the drawing" for the first such texts; empty: all is
  /// well.
  [[nodiscard]] std::string fault() const;
};

/// Nothing if the document is not well-formed or not SVG.
[[nodiscard]] std::optional<SvgTexts> read_svg(const std::string& document);

}  // namespace stormproof::draw
