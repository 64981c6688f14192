// What an implementation costs that the project knows: lines and folders of the files that have its
// word in their path. A test holds both against a list, so that the price of the next one is seen
// when it rises, and the list follows when it falls.
#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "tests/structure/includes.hpp"

namespace stormproof::structure {

/// The most that one implementation costs.
struct VendorCost {
  std::string word;
  std::size_t lines = 0;
  std::size_t folders = 0;
};

/// The cost of the files in whose path the word stands, or begins another: behind a slash, a dot or
/// an underscore, or at the start.
[[nodiscard]] VendorCost cost_of(const Texts& texts, const std::string& word);

/// The implementation costs no more than its limit says, and not much less: a limit of lines is at
/// most a tenth, or twenty lines, above what there is, and one of folders is exact.
[[nodiscard]] std::vector<std::string> check_cost(const Texts& texts, const VendorCost& limit);

}  // namespace stormproof::structure
