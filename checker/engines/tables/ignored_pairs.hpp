// The list of pairs of state and event that may legally do nothing, specs/ignored-pairs.yaml as it
// was when the program was built.
#pragma once

#include <set>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace stormproof::tables {

/// The text of specs/ignored-pairs.yaml and of specs/expected/commutation.yaml.
extern const char* const ignored_pairs_text;
extern const char* const expected_commutation_text;

struct IgnoredPairs {
  using Pair = std::pair<std::string, std::string>;  // state, event

  std::set<Pair> no_row;          ///< the pair has no row
  std::set<Pair> guards_reject;   ///< it has rows, but on some input none of them is enabled
  std::vector<Pair> never_occur;  ///< those without a row that a run cannot produce
};

/// The entries of one machine. Throws std::exception if the text is not what it should be.
[[nodiscard]] IgnoredPairs ignored_pairs(std::string_view machine);

}  // namespace stormproof::tables
