// Nodes that share a participant, as in a component container: rmw_fastrtps and rmw_cyclonedds
// create one participant for each context, whatever the number of nodes in it. Which endpoints
// belong to which node, they tell in `ros_discovery_info`, which grows with the participant.
#pragma once

#include <cstdint>

#include "model/deployment.hpp"

namespace stormproof::model {

/// `nodes` has one participant for each node. Each `per_participant` (at least 1) of those of a
/// host, in their order, become one: with the endpoints of all, and what each node but the first
/// brings along; it starts with the first of them and has created all endpoints with the last. The
/// last one of a host may have fewer nodes.
[[nodiscard]] Deployment sharing_participants(const Deployment& nodes,
                                              std::uint32_t per_participant);

/// `ros_discovery_info` is user data, which no model sends. A participant sends it whole again when
/// it has created endpoints (rmw_dds_common, context.cpp), with a gid of 24 B for each that there
/// is by then (Humble); names of nodes come on top. Returns the UDP payload bytes that the last one
/// of the participant with the most endpoints has at least.
[[nodiscard]] Bytes last_graph_info(const Deployment& deployment);

}  // namespace stormproof::model
