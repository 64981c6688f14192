// Texts in drawings, broken into lines at spaces.
#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace stormproof::draw {

/// Lines of at most `width` columns, except for longer words; at least one line. All but the first
/// are indented by `indent` spaces, which count.
[[nodiscard]] std::vector<std::string> wrapped(std::string_view text, std::size_t width,
                                               std::size_t indent = 0);

}  // namespace stormproof::draw
