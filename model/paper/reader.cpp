// The reader side: what DATA and HEARTBEATs do at the receiver, and the ACKNACKs that it generates.
// A bitmap is a snapshot: it does not change after the ACKNACK is generated, which is what makes
// late DATA look lost.
#include "model/paper/protocol.hpp"

namespace stormproof::model::paper {

void Protocol::data_received(const Packet& packet) {
  const std::uint32_t relation = packet.relation();
  Relation& r = relations_[relation];
  const std::uint32_t fresh = descriptors_.count_missing(relation, packet.descriptors);
  if (takes_data(relation, r.missing - fresh)) {
    if (completes(fresh)) note_last_delivery(relation, descriptors_.missing(relation).lowest());
    descriptors_.receive(relation, packet.descriptors);
    r.missing -= fresh;
    run_.missing -= fresh;
    run_.useful_deliveries += fresh;
  }
  run_.duplicate_deliveries += packet.descriptors.count() - fresh;
  if (run_.ends_now()) return;  // T_disc is now; the rest of the packet is not processed
  if (packet.carries_heartbeat) heartbeat_received(relation);
}

void Protocol::heartbeat_received(std::uint32_t relation) {
  if (!sees_heartbeat(relation)) return;
  run_.schedule(run_.now + sedp_.heartbeat_response_delay, EventKind::acknack_generation, relation);
}

void Protocol::emit_acknack(std::uint32_t relation, bool initial) {
  ++run_.counts.acknack;
  Packet packet = packet_on(PacketKind::acknack, relation, sedp_.acknack_bytes.count());
  packet.descriptors = descriptors_.missing(relation);
  packet.initial_acknack = initial;
  if (!initial && !packet.descriptors.empty()) {
    // The bitmap takes four bytes for every 32 descriptors of the stream.
    packet.payload_bytes += 4 * ((run_.topology.descriptor_count(relation) + 31) / 32);
  }
  network_.emit(ends(relation).destination, std::move(packet));
}

void Protocol::renew_bitmap(Packet& acknack) {
  acknack.descriptors = descriptors_.missing(acknack.relation());
}

}  // namespace stormproof::model::paper
