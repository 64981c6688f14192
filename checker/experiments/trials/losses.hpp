// Which packets of a run are lost, if all that is known is how many are.
#pragma once

#include <cstdint>
#include <vector>

namespace stormproof::trials {

/// Ascending numbers of the packets that are lost, each packet with this probability, for the first
/// two million packets of a run. The same seed gives the same numbers on every machine.
[[nodiscard]] std::vector<std::uint64_t> draw_losses(double probability, std::uint64_t seed);

}  // namespace stormproof::trials
