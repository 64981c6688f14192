// Several SVG drawings in one HTML page. Each is a document of its own, with a style sheet and
// named arrow heads; in a page these would act on everything. Here each style sheet gets a class
// that its rules are bound to, names become unique, and what several drawings share is written
// once.
#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace stormproof::report {

class Drawings {
 public:
  /// The drawing for use inside the page, without style sheet and definitions. `id` names it in the
  /// page; may be empty. Nothing if `svg` is no drawing.
  [[nodiscard]] std::string add(std::string_view svg, std::string_view id = {});

  /// CSS for the page. Colours for dark viewers act on screens only: on paper everything is light.
  /// The attribute data-theme of the root element, "light" or "dark", overrules the preference.
  [[nodiscard]] std::string style() const;

  /// What must stand somewhere in the page: the arrow heads that the drawings use. Takes no room.
  [[nodiscard]] std::string definitions() const;

 private:
  struct Kind {
    std::string style;
    std::string definitions;
  };
  std::vector<Kind> kinds_;
};

}  // namespace stormproof::report
