// Functions that nobody calls but a test: what is there for tests alone belongs to them, and what
// nobody calls belongs nowhere. Found by their names, without a compiler: a header declares it, and
// in all sources the name stands there and, at most, once more, where it is defined. A name that
// two functions share is left alone, so what is found is true, and not everything is found.
#pragma once

#include <string>
#include <vector>

#include "tests/structure/includes.hpp"

namespace stormproof::structure {

/// No other functions of the headers than the allowed ones are named nowhere else; and each of the
/// allowed ones is such a function. An entry is its name, or a folder of headers (with its '/').
[[nodiscard]] std::vector<std::string> check_callers(const Texts& texts,
                                                     const std::vector<std::string>& allowed);

}  // namespace stormproof::structure
