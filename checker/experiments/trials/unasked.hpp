// What a study did not ask because it was to keep to its time, and which runs it cut: said by every
// verb in the same words, and never counted as if it had been measured.
#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "checker/presentation/document/document.hpp"
#include "model/units.hpp"

namespace stormproof::trials {

struct Unasked {
  /// "runs of the search": 340 of 1,200 that were asked for.
  struct Fewer {
    std::string what;
    std::size_t made = 0, wanted = 0;
  };
  /// "runs of the search" that were ended at `at` of simulated time.
  struct Cut {
    std::string what;
    std::size_t runs = 0;
    model::Nanoseconds at{};
  };
  std::vector<Fewer> fewer;
  std::vector<std::string> left_out;  ///< "pairs": wholly
  std::vector<Cut> cuts;

  /// Notes it if not all were made.
  void note(std::string what, std::size_t made, std::size_t wanted);

  /// Whether there was no time for something.
  [[nodiscard]] bool lacked_time() const { return !fewer.empty() || !left_out.empty(); }
};

/// One for each, without a full stop: "340 of 1,200 runs of the search", "no pairs", "cut: 12 runs
/// of the search at 4.1 s of simulated time".
[[nodiscard]] std::vector<std::string> sentences_of(const Unasked& unasked);

/// A line each of what there was no time for and what was cut, if there is any.
void add_unasked(report::Facts& facts, const Unasked& unasked);

}  // namespace stormproof::trials
