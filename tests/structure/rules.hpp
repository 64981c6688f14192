// What the includes of the sources have to obey. Each rule returns its complaints, one sentence
// each; none means that it holds.
#pragma once

#include <string>
#include <vector>

#include "tests/structure/includes.hpp"

namespace stormproof::structure {

/// The folders from the bottom to the top, one layer after the other. An entry is a folder, for the
/// files directly in it, or the path of some of its files without their extension. Entries of one
/// layer stand side by side.
using Layers = std::vector<std::vector<std::string>>;

/// A file includes files of its own entry and of lower layers: no arrow goes up or sideways, so no
/// folders include each other in a circle. Every file is in an entry, and every entry has a file.
[[nodiscard]] std::vector<std::string> check_folders(const Includes& includes,
                                                     const Layers& layers);

/// A library whose headers take long to compile, and whose headers may reach it.
struct HeavyHeaders {
  std::string library;               ///< how its headers begin: "boost/", "z3++.h"
  std::vector<std::string> allowed;  ///< headers, or folders (which end in '/')
};

/// No other header than the allowed ones reaches the library, over however many includes; and each
/// of the allowed ones does.
[[nodiscard]] std::vector<std::string> check_heavy_headers(const Includes& includes,
                                                           const HeavyHeaders& rule);

/// A word that belongs to some files; blanks do not count.
struct ReservedWord {
  std::string word;
  std::vector<std::string> allowed;
};

/// No other file than the allowed ones says the word; and each of the allowed ones does.
[[nodiscard]] std::vector<std::string> check_word(const Texts& texts, const ReservedWord& rule);

}  // namespace stormproof::structure
