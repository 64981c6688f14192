// Packets as traces show them.
#pragma once

#include <span>
#include <string>

#include "model/engine/packet.hpp"
#include "model/engine/topology.hpp"

namespace stormproof::model::trace {

/// The two ends of one packet.
struct Ends {
  std::uint32_t from = 0;
  std::uint32_t to = 0;  ///< not for a multicast
};
[[nodiscard]] Ends packet_ends(const Packet& packet, const Topology& topology);

[[nodiscard]] bool is_spdp(const Packet& packet);
/// Whether it belongs to a control-only relation, whose number is `packet.detail`.
[[nodiscard]] bool is_control(const Packet& packet);

/// Appends ',"stream":"pub"', or the control-only relation, or nothing for SPDP.
void append_stream(std::string& out, const Packet& packet);

/// Appends '"kind":…,"from":…,"to":[…],"stream":…,"bytes":…' and what the packet carries.
void append_packet(std::string& out, const Packet& packet, std::uint32_t from,
                   std::span<const std::uint32_t> destinations);

}  // namespace stormproof::model::trace
