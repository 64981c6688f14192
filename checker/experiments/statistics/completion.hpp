// What a run that did not complete means, everywhere: the time of its completion is not known, but
// it lies above that of every run that completed ("unreached"). So it is +∞ as a number, which
// order statistics take as it is (quantiles, ranks, coverage, the paired test), and `null` in JSON;
// a mean with such a run does not exist. Neither the time limit nor a run that is left out may
// stand for it: both would make a setting look better the more often it fails.
#pragma once

#include <limits>
#include <optional>

#include "model/units.hpp"

namespace stormproof::statistics {

inline constexpr double unreached = std::numeric_limits<double>::infinity();

/// In ns.
[[nodiscard]] constexpr double completion_ns(const std::optional<model::Nanoseconds>& completion) {
  return completion ? static_cast<double>(completion->count()) : unreached;
}

}  // namespace stormproof::statistics
