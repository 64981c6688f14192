// The texts of a source tree, and their #include lines. The rules about them
// (tests/structure/rules.hpp) look at nothing else, so they need no compiler and hold for every
// configuration.
#pragma once

#include <map>
#include <string>
#include <vector>

namespace stormproof::structure {

/// What each file includes, as it is written between quotes or angle brackets; by the path of the
/// file from the root of the tree.
using Includes = std::map<std::string, std::vector<std::string>>;

/// The included names of a source text, in its order.
[[nodiscard]] std::vector<std::string> includes_of(const std::string& text);

/// What each file says, by its path from the root of the tree.
using Texts = std::map<std::string, std::string>;

/// All .hpp and .cpp files in and below these folders of `root`.
[[nodiscard]] Texts read_texts(const std::string& root, const std::vector<std::string>& folders);
[[nodiscard]] Includes includes_of(const Texts& texts);

/// The lines of a data file with their words; what follows '#' is a comment, empty lines are left
/// out.
[[nodiscard]] std::vector<std::vector<std::string>> read_words(const std::string& file);

}  // namespace stormproof::structure
