// The random scenarios on which two simulators are compared: those of the generators that property
// tests use, by seed.
#pragma once

#include <cstdint>

#include "props/generators/space.hpp"

namespace stormproof::oracle {

/// The scenario of this seed, the same on every platform; small seeds give the same sizes as large
/// ones.
inline model::Scenario random_scenario(std::uint64_t seed, model::ImplementationKind kind) {
  return props::draw_scenario(seed, static_cast<int>(seed % 101), {.implementation = kind});
}
inline model::Scenario random_scenario(std::uint64_t seed) {
  return random_scenario(seed, model::ImplementationKind::paper);
}
inline model::Scenario random_fastdds_scenario(std::uint64_t seed) {
  return random_scenario(seed, model::ImplementationKind::fastdds);
}
inline model::Scenario random_cyclone_scenario(std::uint64_t seed) {
  return random_scenario(seed, model::ImplementationKind::cyclone);
}

}  // namespace stormproof::oracle
