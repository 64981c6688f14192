// The scenarios that benchmarks run.
#pragma once

#include <cstdint>

#include "model/scenario.hpp"

namespace stormproof::bench {

[[nodiscard]] model::Scenario homogeneous(std::uint32_t hosts, std::uint32_t participants,
                                          std::uint32_t endpoints);
/// Fast DDS on the live machine's access point, with its endpoint creation: 2 hosts, one schedule
/// drawn from `seed`.
[[nodiscard]] model::Scenario live(std::uint32_t participants, std::uint32_t endpoints,
                                   std::uint64_t seed);
/// A deployment that never comes to an end, for a minute.
[[nodiscard]] model::Scenario collapse(std::uint32_t hosts, std::uint32_t participants,
                                       std::uint32_t endpoints);

}  // namespace stormproof::bench
