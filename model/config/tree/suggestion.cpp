// Edit distance with insertion, removal, replacement and exchange of neighbours (Levenshtein,
// Damerau), by the usual recurrence over rows. Words longer than any key cannot be near one.
#include "model/config/tree/suggestion.hpp"

#include <algorithm>
#include <numeric>
#include <utility>
#include <vector>

#include <fmt/core.h>

namespace stormproof::model::config {
namespace {

std::size_t edit_distance(std::string_view a, std::string_view b) {
  std::vector<std::size_t> two_above;
  std::vector<std::size_t> above(b.size() + 1);
  std::iota(above.begin(), above.end(), std::size_t{0});
  for (std::size_t row = 1; row <= a.size(); ++row) {
    std::vector<std::size_t> current{row};
    for (std::size_t column = 1; column <= b.size(); ++column) {
      const bool is_same = a[row - 1] == b[column - 1];
      std::size_t least = std::min(above[column], current[column - 1]) + 1;
      least = std::min(least, above[column - 1] + (is_same ? 0 : 1));
      if (row > 1 && column > 1 && a[row - 1] == b[column - 2] && a[row - 2] == b[column - 1]) {
        least = std::min(least, two_above[column - 2] + 1);
      }
      current.push_back(least);
    }
    two_above = std::exchange(above, std::move(current));
  }
  return above.back();
}

}  // namespace

std::string suggestion(std::string_view word, std::span<const std::string> candidates) {
  constexpr std::size_t longest_word = 100;
  if (word.size() > longest_word) return {};
  std::string_view nearest;
  std::size_t least = std::max<std::size_t>(2, word.size() / 3) + 1;
  for (const std::string& candidate : candidates) {
    const std::size_t distance = edit_distance(word, candidate);
    if (distance < least && distance < candidate.size()) {
      least = distance;
      nearest = candidate;
    }
  }
  return nearest.empty() ? std::string{} : fmt::format("; did you mean '{}'?", nearest);
}

}  // namespace stormproof::model::config
