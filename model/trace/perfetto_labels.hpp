// What slices of the timeline are called.
#pragma once

#include <string>

#include "model/engine/packet.hpp"
#include "model/engine/topology.hpp"
#include "model/probe.hpp"

namespace stormproof::model::trace {

/// "HEARTBEAT", "repair DATA", "initial ACKNACK", "SPDP".
[[nodiscard]] const char* packet_label(const Packet& packet);

/// "HEARTBEAT 3→7 sub", "SPDP 3→all".
[[nodiscard]] std::string service_label(const Packet& packet, const Topology& topology);
/// "HEARTBEAT to 7", "SPDP to 5 participants", "repair DATA to 7, 12 descriptors".
[[nodiscard]] std::string emission_label(const Packet& packet,
                                         std::span<const std::uint32_t> destinations);
/// "HEARTBEAT from 3", "DATA from 3, 12 descriptors".
[[nodiscard]] std::string arrival_label(const Packet& packet, std::uint32_t from);

/// "ACKNACK generation": an event of the protocol.
[[nodiscard]] const char* timer_label(EventKind kind);
/// "suppression started": what a slice does that starts a timer and has no other name.
[[nodiscard]] const char* timer_start_label(EventKind kind);

}  // namespace stormproof::model::trace
