// When a participant creates its endpoints, in the order of a ROS 2 node
// (model/engine/node_endpoints.hpp): one after the other, evenly, as the deployment says.
#pragma once

#include <cstdint>

#include "model/engine/node_endpoints.hpp"
#include "model/engine/run_state.hpp"

namespace stormproof::model {

/// The k-th endpoint that participant i creates.
[[nodiscard]] Endpoint creation_of(const Topology& topology, std::uint32_t i, std::uint32_t k);
/// Participant i starts then; creation k has k as its detail.
void schedule_creations(RunState& run, std::uint32_t i, Nanoseconds start);

}  // namespace stormproof::model
