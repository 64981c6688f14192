// Help that a terminal of usual width shows: descriptions of options break at blanks and go on
// below where they begin, while examples, which people copy, stay as they are.
#pragma once

#include <cstddef>
#include <string>

namespace stormproof::cli {

/// No line is wider than `columns`, if it has a blank to be broken at and is no example.
[[nodiscard]] std::string narrow_help(const std::string& help, std::size_t columns);

}  // namespace stormproof::cli
