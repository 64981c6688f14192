// The frame of a page. Its policy forbids to load anything at all, even if a mistake in the rest
// asked for it.
#include "checker/presentation/document/html_page.hpp"

#include <fmt/core.h>

#include "checker/presentation/diagrams/svg.hpp"
#include "checker/presentation/text/plain_text.hpp"

namespace stormproof::report {

std::string html_text(std::string_view text) { return draw::xml_text(valid_text(text)); }

std::string html_page(std::string_view title, std::string_view body, const Drawings& drawings) {
  return fmt::format(
      "<!DOCTYPE html>\n<html lang=\"en\">\n<head>\n<meta charset=\"utf-8\">\n"
      "<meta name=\"viewport\" content=\"width=device-width, initial-scale=1\">\n"
      "<meta name=\"color-scheme\" content=\"light dark\">\n"
      "<meta http-equiv=\"Content-Security-Policy\" content=\"default-src 'none'; "
      "style-src 'unsafe-inline'; script-src 'unsafe-inline'; base-uri 'none'; "
      "form-action 'none'\">\n"
      "<title>{}</title>\n<style>{}{}</style>\n</head>\n<body>\n"
      "<button type=\"button\" id=\"theme\" class=\"only-script\" hidden>Dark colours</button>\n"
      "{}<main>\n{}</main>\n<script>{}</script>\n</body>\n</html>\n",
      html_text(title), page_style(), drawings.style(), drawings.definitions(), body,
      page_script());
}

}  // namespace stormproof::report
