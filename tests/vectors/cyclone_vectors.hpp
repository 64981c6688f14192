// The test vectors of `implementation: cyclone`, in the same form as the others: implementations
// that were written apart agree on them exactly.
#pragma once

#include <cstdint>
#include <vector>

#include "model/scenario.hpp"
#include "tests/vectors/paper_vectors.hpp"

namespace stormproof::vectors {

[[nodiscard]] const std::vector<Vector>& cyclone_vectors();

/// Two hosts with participants that start one after the other, on the channel of the vectors.
[[nodiscard]] model::Scenario cyclone_grid(std::uint32_t participants_per_host,
                                           std::uint32_t endpoints,
                                           model::AllowMulticast multicast);

}  // namespace stormproof::vectors
