// Random scenarios of `implementation: fastdds` for the comparison of two simulators: small and
// heterogeneous, with every knob that this implementation uses in play, timers from nothing to a
// second, same-host neighbours, and many events at the very same time.
#pragma once

#include <cstdint>

#include "model/scenario.hpp"

namespace stormproof::oracle {

/// The scenario of this seed, the same on every platform. It always has a cross-host pair, and its
/// time limit keeps nearly every run below 200,000 events.
[[nodiscard]] model::Scenario random_fastdds_scenario(std::uint64_t seed);

}  // namespace stormproof::oracle
