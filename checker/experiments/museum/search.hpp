// Whether some pattern of lost packets breaks a claim: all of them up to so many losses are run,
// the patterns with the fewest losses first, so that what is found is shortest. Packets are lost by
// their number in the order of emission, so a pattern says what is lost of the run that it makes.
// Everything else of the run is that of the scenario: constant delays where it has such.
#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "checker/experiments/museum/exhibit.hpp"
#include "props/verdict.hpp"

namespace stormproof::museum {

struct Found {
  props::VerdictKind verdict = props::VerdictKind::inconclusive;
  std::uint64_t runs = 0;
  std::vector<std::uint64_t> lost;  ///< of the counterexample
  std::optional<props::Counterexample> counterexample;
  /// Over all runs that are complete: the latest completion.
  std::optional<model::Nanoseconds> latest;
  std::string how;                       ///< what was decided, one sentence
  std::vector<std::string> assumptions;  ///< of a proof
};

/// `go_on` is asked before each run and within it; if it says no, the verdict is inconclusive.
[[nodiscard]] Found search(const Exhibit& exhibit, const Variant& variant,
                           const std::function<bool()>& go_on);

}  // namespace stormproof::museum
