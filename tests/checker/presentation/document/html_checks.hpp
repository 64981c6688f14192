// What a browser would complain about or load, found without one.
#pragma once

#include <map>
#include <string>
#include <vector>

namespace stormproof::report {

/// The first tag that is closed out of order or never, or has an unquoted attribute; or an id that
/// is there twice. Empty: none.
[[nodiscard]] std::string html_fault(const std::string& page);

/// Everything in the page that a browser would fetch from elsewhere.
[[nodiscard]] std::vector<std::string> outside_requests(const std::string& page);

/// The custom properties (--name: #rrggbb) of the rule that stands behind `selector` in `css`.
[[nodiscard]] std::map<std::string, std::string> colours(const std::string& css,
                                                         const std::string& selector);

/// Contrast of two colours "#rrggbb" as WCAG defines it: 1 … 21.
[[nodiscard]] double contrast(const std::string& a, const std::string& b);

}  // namespace stormproof::report
