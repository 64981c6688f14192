// Long sentences in text reports: broken at spaces, indented, at most 100 columns wide.
#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace stormproof::report {

inline constexpr std::size_t report_width = 100;

/// Columns that `text` takes; multi-byte characters count as one.
[[nodiscard]] std::size_t columns(std::string_view text);

/// Lines of at most `width` columns, except for longer words; at least one line. The first starts
/// with `first`, the others with `indent` spaces, which count.
[[nodiscard]] std::vector<std::string> wrapped(std::string_view text, std::size_t width,
                                               std::size_t indent = 0, std::string_view first = {});

/// `text` broken into lines of at most `width` columns, each ending in a line feed. The first line
/// starts with `first`, the others with as many spaces as `first` has columns.
[[nodiscard]] std::string paragraph(std::string_view first, std::string_view text,
                                    std::size_t width = report_width);

}  // namespace stormproof::report
