// Several drawings on one sheet. Each is an <svg> of its own inside the outer one; the style sheet
// and the arrow heads, which must be the same in all of them, stand there once, and no id twice.
#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace stormproof::draw {

/// A document of `Svg::finish`, taken apart.
struct SvgParts {
  int width = 0;
  int height = 0;
  std::string style;     ///< the <style> element
  std::string markers;   ///< the <defs> element
  std::string contents;  ///< all other elements but the title and the description
};
[[nodiscard]] SvgParts take_apart(const std::string& document);

struct PlacedDrawing {
  SvgParts drawing;
  int x = 0;
  int y = 0;
};

/// A self-contained document, as large as the drawings need. `elements` go with them: headings,
/// lines. The title is for those who cannot see it.
[[nodiscard]] std::string svg_sheet(std::string_view title, std::string_view description,
                                    const std::vector<PlacedDrawing>& drawings,
                                    std::string_view elements = {});

}  // namespace stormproof::draw
