// HTML reports: one page that needs nothing else, so that it opens offline, from an e-mail or a CI
// artifact, and can do no harm. Colours follow the viewer's light or dark preference; a button
// overrules it. Without JavaScript everything is there but the steppers' controls.
#pragma once

#include <string>
#include <string_view>

#include "checker/presentation/document/drawings.hpp"

namespace stormproof::report {

/// `text` for a place between tags or in a quoted attribute: nothing in it is HTML.
[[nodiscard]] std::string html_text(std::string_view text);

/// The page. `title` is plain text; `body` is HTML, and `drawings` holds what is drawn in it.
[[nodiscard]] std::string html_page(std::string_view title, std::string_view body,
                                    const Drawings& drawings);

/// The style sheet of all pages, and the script that moves steppers and themes.
[[nodiscard]] std::string_view page_style();
[[nodiscard]] std::string_view page_script();

}  // namespace stormproof::report
