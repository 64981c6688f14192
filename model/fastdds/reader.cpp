// The reader: it knows how many descriptors were announced, asks only for those, and tells its
// application about new ones in order. HEARTBEATs within the response delay share one ACKNACK.
#include <algorithm>

#include "model/fastdds/protocol.hpp"

namespace stormproof::model::fastdds {

void Protocol::data_received(const Packet& packet) {
  const std::uint32_t relation = packet.relation();
  const std::uint32_t fresh = changes_.count_missing(relation, packet.descriptors);
  const bool taken = takes_data(relation, relations_[relation].missing - fresh);
  if (crosses(relation)) {
    run_.duplicate_deliveries += packet.descriptors.count() - fresh;
    if (taken) run_.useful_deliveries += fresh;
  }
  if (taken) take(relation, packet.descriptors, fresh);
  if (run_.ends_now()) return;  // T_disc is now; the rest of the packet is not processed
  if (packet.carries_heartbeat) heartbeat_received(relation, packet.detail);
}

void Protocol::take(std::uint32_t relation, const DescriptorSet& descriptors, std::uint32_t fresh) {
  Relation& r = relations_[relation];
  if (crosses(relation) && completes(fresh)) {
    note_last_delivery(relation, changes_.missing(relation).lowest());
  }
  changes_.receive(relation, descriptors);
  r.missing -= fresh;
  r.announced = std::max(r.announced, descriptors.highest() + 1);
  if (!crosses(relation)) return;
  run_.missing -= fresh;
  if (run_.ends_now()) return;
  const std::uint32_t count = run_.topology.descriptor_count(relation);
  while (r.notified < count && changes_.has_received(relation, r.notified)) {
    const std::uint32_t d = r.notified++;
    control_.notified(relation / 2, stream_of(relation), d);
  }
}

void Protocol::heartbeat_received(std::uint32_t relation, std::uint32_t announced) {
  if (!sees_heartbeat(relation)) return;
  Relation& r = relations_[relation];
  r.announced = std::max(r.announced, announced);
  request(relation_shots_, r.reply, sedp_.heartbeat_response_delay, EventKind::acknack_generation,
          relation);
}

void Protocol::acknack_generation(std::uint32_t relation) {
  if (!expire(relation_shots_, relations_[relation].reply, relation)) return;
  DiscoveryBase::acknack_generation(relation);
}

/// The base is the first missing descriptor; the bitmap lists what is missing of what was
/// announced. An initial ACKNACK claims nothing: base 0, empty bitmap.
void Protocol::emit_acknack(std::uint32_t relation, bool initial) {
  if (crosses(relation)) ++run_.counts.acknack;
  Packet packet = packet_on(PacketKind::acknack, relation, acknack_bytes);
  packet.initial_acknack = initial;
  if (!initial) {
    ask(packet);
    if (!packet.descriptors.empty()) {
      packet.payload_bytes += static_cast<std::uint32_t>(acknack_bitmap_bytes);
    }
  }
  send(std::move(packet));
}

void Protocol::ask(Packet& acknack) {
  const std::uint32_t relation = acknack.relation();
  acknack.detail =
      std::min(changes_.missing(relation).lowest(), run_.topology.descriptor_count(relation));
  acknack.descriptors = changes_.missing(relation, relations_[relation].announced);
}

void Protocol::renew_bitmap(Packet& acknack) {
  if (!acknack.initial_acknack) ask(acknack);
}

}  // namespace stormproof::model::fastdds
