// What goes out between the server and its clients: how much it weighs, as what it counts.
// Everything goes to one reader at a time. The bodies of ServerHost.
#pragma once

#include <memory>
#include <utility>

#include "model/fastdds/server_host.hpp"

namespace stormproof::model::fastdds {

inline constexpr std::int64_t numbers_in_word = 32;
inline constexpr std::int64_t word_bytes = 4;
inline constexpr std::int64_t gap_bytes = 72;
inline constexpr std::int64_t gap_with_heartbeat_bytes = 100;
inline constexpr std::int64_t goodbye_bytes = 132;  ///< without the HEARTBEAT that rides

template <class Self, class Base, class Composition_, class Columns>
void ServerHost<Self, Base, Composition_, Columns>::send_registration(PacketKind kind, Number pair,
                                                                      bool initial) {
  const bool cross_host = this->topology().pair(pair).cross_host;
  std::int64_t bytes = acknack_bytes;
  std::uint64_t* count = &this->generated().pdp_acknack;
  if (kind == PacketKind::registration) {
    bytes = this->own_of(0).sizes.registration;
    count = &this->generated().pdp_data;
  } else if (kind == PacketKind::registration_heartbeat) {
    bytes = heartbeat_to_one_bytes;
    count = &this->generated().pdp_heartbeat;
  }
  if (cross_host) ++*count;
  Packet packet = this->packet_of(kind, pair, bytes);
  packet.initial_acknack = initial;
  if (kind == PacketKind::registration_acknack)
    packet.set_number_of_acknack(
        this->next_acknack(this->topology().pair(pair).destination, relay::announcements));
  this->send(std::move(packet));
}

template <class Self, class Base, class Composition_, class Columns>
void ServerHost<Self, Base, Composition_, Columns>::send_acknack(Number relation, bool initial) {
  const Number relay = relation % relay::count;
  const bool of_announcements = relay == relay::announcements;
  Relayed acknack = this->contents(server::RelayedAckNack{}, relation, initial);
  std::int64_t bytes = acknack_bytes;
  if (!acknack.numbers.empty()) {
    const std::int64_t span = acknack.numbers.back() - acknack.numbers.front() + 1;
    bytes += word_bytes * ((span + numbers_in_word - 1) / numbers_in_word);
  }
  const Number pair = relation / relay::count;
  if (this->topology().pair(pair).cross_host) {
    ++(of_announcements ? this->generated().pdp_acknack : this->generated().acknack);
  }
  Packet packet = this->packet_of(PacketKind::relayed_acknack, pair, bytes);
  packet.detail = relay;
  packet.stream = relay == relay::subscriptions ? Stream::sub : Stream::pub;
  packet.initial_acknack = initial;
  packet.use = of_announcements ? TrafficClass::spdp : TrafficClass::acknack;
  packet.relayed = std::make_shared<const Relayed>(std::move(acknack));
  this->send(std::move(packet));
}

/// Counts and sends it.
template <class Self, class Base, class Composition_, class Columns>
void ServerHost<Self, Base, Composition_, Columns>::send_relayed(Number relation, Relayed relayed) {
  const Number relay = relation % relay::count;
  const Number pair = relation / relay::count;
  const bool of_announcements = relay == relay::announcements;
  const bool cross_host = this->topology().pair(pair).cross_host;
  Counts& counts = this->generated();
  if (relayed.has_heartbeat && cross_host) {
    ++(of_announcements ? counts.pdp_heartbeat : counts.heartbeat);
  }
  Packet packet = this->packet_of(PacketKind::relayed, pair, heartbeat_to_one_bytes);
  packet.use = of_announcements ? TrafficClass::spdp : TrafficClass::heartbeat;
  const auto weigh = [&](std::int64_t bytes) {
    packet.payload_bytes = static_cast<std::uint32_t>(bytes);
  };
  if (!relayed.numbers.empty()) {
    if (cross_host) ++counts.gap;
    weigh(relayed.has_heartbeat ? gap_with_heartbeat_bytes : gap_bytes);
  } else if (relayed.has_data && relayed.is_announcement) {
    if (cross_host) ++counts.pdp_data;
    const std::int64_t ride = relayed.has_heartbeat ? heartbeat_submessage_bytes : 0;
    const Number self = this->topology().pair(pair).source;
    const VersionSizes& sizes = this->own_of(self).sizes;
    const bool of_server = relayed.participant == self;
    weigh(ride + (relayed.is_goodbye ? goodbye_bytes
                  : of_server        ? sizes.of_server
                                     : sizes.passed_on));
  } else if (relayed.has_data) {
    const bool initial = this->is_first_for(relation, relayed);
    const auto writer = static_cast<Number>(2 * relayed.participant + index_of(relayed.stream));
    if (cross_host) ++(initial ? counts.initial_data : counts.repair_data);
    packet.carries_initial = initial;
    packet.use = initial ? TrafficClass::initial_data : TrafficClass::repair_data;
    weigh(message_header_bytes + destination_bytes + timestamp_bytes +
          this->bytes_of(writer, relayed.descriptor) + heartbeat_submessage_bytes);
  }
  packet.detail = relay;
  packet.carries_heartbeat = relayed.has_heartbeat;
  packet.stream = relay == relay::subscriptions ? Stream::sub : Stream::pub;
  packet.relayed = std::make_shared<const Relayed>(std::move(relayed));
  this->send(std::move(packet));
}

}  // namespace stormproof::model::fastdds
