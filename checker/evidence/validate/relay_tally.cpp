// What a Discovery Server and its clients send, by the rules of a capture.
#include "checker/evidence/validate/message_tally.hpp"
#include "model/fastdds/matching.hpp"
#include "model/fastdds/relay.hpp"
#include "model/fastdds/relayed.hpp"

namespace stormproof::validate {

using model::MessageClass;
using model::PacketKind;

/// Whether discovery waits for something in a DATA: of a client for its server what somebody needs.
bool MessageTally::is_needed(const model::Packet& packet) const {
  if (!has_server_) return true;
  const std::uint32_t owner = topology_->pair(packet.pair).source;
  bool needed = false;
  packet.descriptors.for_each([&](std::uint32_t d) {
    for (std::uint32_t j = 0; j + 1 < topology_->participant_count(); ++j) {
      needed |= j != owner && model::fastdds::has_other_side(*topology_, j, packet.stream, d);
    }
  });
  return needed;
}

/// Reliable announcements are figures of their own; what is relayed of SEDP is in its classes.
bool MessageTally::add_of_server(const model::Packet& packet) {
  switch (packet.kind) {
    case PacketKind::registration:
      validate::add_of_server(tally_, Figure::pdp_data);
      return true;
    case PacketKind::registration_heartbeat:
      validate::add_of_server(tally_, Figure::pdp_heartbeat);
      return true;
    case PacketKind::registration_acknack:
      validate::add_of_server(tally_, Figure::pdp_acknack);
      return true;
    case PacketKind::relayed:
    case PacketKind::relayed_acknack:
      add_relay(packet);
      return true;
    default:
      return false;
  }
}

void MessageTally::add_relay(const model::Packet& packet) {
  const bool is_acknack = packet.kind == PacketKind::relayed_acknack;
  const model::Relayed& relayed = *packet.relayed;
  if (!is_acknack && !relayed.numbers.empty()) ++tally_[index_of(Figure::gap)];
  if (packet.detail == model::fastdds::relay::announcements) {
    if (relayed.has_data) validate::add_of_server(tally_, Figure::pdp_data);
    if (relayed.has_heartbeat) validate::add_of_server(tally_, Figure::pdp_heartbeat);
    if (is_acknack) validate::add_of_server(tally_, Figure::pdp_acknack);
    return;
  }
  if (is_acknack || relayed.has_data || relayed.has_heartbeat) {
    ++tally_[index_of(Figure::datagrams)];
    tally_[index_of(Figure::payload_bytes)] += packet.payload_bytes;
  }
  if (is_acknack) {
    return add_acknack(packet, !relayed.numbers.empty(),
                       packet.initial_acknack || relayed.base <= 1);
  }
  add_relayed(packet);
}

/// The server's DATA is initial once for each client and endpoint, whatever number it has.
void MessageTally::add_relayed(const model::Packet& packet) {
  const model::Relayed& relayed = *packet.relayed;
  const auto count = [&](MessageClass one) {
    add(tally_, one);
    ++sizes_[model::index_of(one)][packet.payload_bytes];
  };
  if (relayed.has_heartbeat) count(MessageClass::heartbeat);
  if (!relayed.has_data) return;
  count(packet.carries_initial ? MessageClass::initial_data : MessageClass::repair_data);
  if (!packet.carries_initial) return;
  note_initial();
  const std::uint32_t client = topology_->pair(packet.pair).destination;
  if (model::fastdds::has_other_side(*topology_, client, relayed.stream, relayed.descriptor)) {
    emitted_initial_ = true;
  }
}

}  // namespace stormproof::validate
