// What a wireless profile with a constant delay says of one packet, by its number in the order of
// emission: read here apart from the simulator, which is held against it.
#pragma once

#include <algorithm>
#include <cstdint>

#include "model/wireless_profile.hpp"

namespace stormproof::props {

[[nodiscard]] inline bool is_lost(const model::WirelessProfile& wireless, std::uint64_t packet) {
  return std::ranges::binary_search(wireless.lost_packets, packet);
}

/// From its emission until its reception, which does not happen if it is lost.
[[nodiscard]] inline model::Nanoseconds one_way_of(const model::WirelessProfile& wireless,
                                                   std::uint64_t packet) {
  const auto place =
      std::ranges::lower_bound(wireless.packet_delays, packet, {}, &model::PacketDelay::packet);
  const bool own = place != wireless.packet_delays.end() && place->packet == packet;
  return own ? place->one_way : wireless.one_way;
}

}  // namespace stormproof::props
