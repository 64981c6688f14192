// The search: settings that fill the space, then variations of the best ones, as long as the budget
// of runs lasts. Every setting meets the same seeds. Most settings are bad, so each generation is a
// race (successive halving): all run a few seeds, the more promising half runs more, and only who
// reaches the end has been run under all seeds. The result depends on the problem, the budget and
// the seed, not on the number of threads.
#pragma once

#include <functional>
#include <map>
#include <string>

#include "checker/experiments/tune/outcome.hpp"

namespace stormproof::tune {

struct SearchOptions {
  std::size_t budget = 1'200;  ///< runs; the last generation may exceed it a little
  Seeds seeds{0, 12};          ///< what a setting is run under
  std::uint64_t random = 0;    ///< seed of the search's own choices
  /// Which part of the time that the search may take is over; empty: the budget alone ends it.
  std::function<double()> time_used{};
};

struct SearchResult {
  /// Settings that keep everything and that no other one dominates under all seeds, by completion.
  std::vector<Point> front;
  Seeds basis;                  ///< what the front was found under
  std::vector<Cost> finalists;  ///< costs of all settings that were run under all seeds
  std::size_t rejected = 0;     ///< settings that break something
  std::map<std::string, std::size_t, std::less<>> rejected_by;  ///< of them, by id
  std::size_t generations = 0;
  bool finished = true;  ///< false: interrupted; then the front is that of what is known
};

[[nodiscard]] SearchResult search(const Problem& problem, Archive& archive,
                                  const SearchOptions& options);

}  // namespace stormproof::tune
