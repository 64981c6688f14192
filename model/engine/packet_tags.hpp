// How packets are called in compositions, and which kind of packet of a run each of them is.
#pragma once

#include <algorithm>
#include <array>
#include <cstdint>
#include <string_view>
#include <utility>

#include "fsm/composition/owner.hpp"
#include "fsm/reflect.hpp"
#include "model/engine/packet.hpp"

namespace stormproof::model {

namespace detail {
using enum PacketKind;
inline constexpr std::array<std::pair<std::string_view, PacketKind>, 15> packets{{
    {"SpdpMulticast", spdp_multicast},
    {"SpdpUnicast", spdp_unicast},
    {"Data", data},
    {"Heartbeat", heartbeat},
    {"AckNack", acknack},
    {"UserHeartbeat", user_heartbeat},
    {"UserAckNack", user_acknack},
    {"LookupSample", lookup},
    {"Registration", registration},
    {"RegistrationHeartbeat", registration_heartbeat},
    {"RegistrationAckNack", registration_acknack},
    {"RelayedData", relayed},
    {"RelayHeartbeat", relayed},
    {"Gap", relayed},
    {"RelayedAckNack", relayed_acknack},
}};
}  // namespace detail

template <class Packet>
inline constexpr PacketKind packet_kind_of = [] {
  const auto* const found = std::ranges::find(detail::packets, fsm::name_of<Packet>(),
                                              &decltype(detail::packets)::value_type::first);
  return found->second;  // not a constant if it is not there
}();

/// Which one of those that have such packets it is about; not of one that goes to everybody.
template <class P>
[[nodiscard]] std::uint32_t number_of(const PacketNumbers& packet) {
  if constexpr (P::owner == fsm::composition::owner::control_relation) {
    return packet.detail;
  } else {
    return P::owner == fsm::composition::owner::pair ? packet.pair : packet.relation();
  }
}

}  // namespace stormproof::model
