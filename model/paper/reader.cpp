// The reader side: what DATA and HEARTBEATs do at the receiver, and the ACKNACKs that it generates.
// A bitmap is a snapshot: it does not change after the ACKNACK is generated, which is what makes
// late DATA look lost.
#include "model/paper/protocol.hpp"

namespace stormproof::model::paper {

namespace reader = fsm::discovery_reader;

void Protocol::data_received(const Packet& packet) {
  const std::uint32_t relation = packet.relation();
  Relation& r = relations_[relation];
  const std::uint32_t fresh = descriptors_.count_missing(relation, packet.descriptors);
  const auto output = reader_driver_.step<reader::DataReceived>(
      run_, r.reader, {.accepts_unmatched = accepts_unmatched_, .missing_after = r.missing - fresh},
      relation);
  if (output.take_data) {
    if (fresh == run_.missing && fresh > 0) {
      run_.last_delivered = {ParticipantId{ends(relation).source},
                             ParticipantId{ends(relation).destination}, stream_of(relation),
                             DescriptorId{descriptors_.missing(relation).lowest()}};
    }
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
  Relation& r = relations_[relation];
  const auto output = reader_driver_.step<reader::HeartbeatReceived>(
      run_, r.reader, {.accepts_unmatched = accepts_unmatched_, .missing_after = r.missing},
      relation);
  if (!output.schedule_acknack) return;
  r.heartbeat_seen = true;
  run_.schedule(run_.now + sedp_.heartbeat_response_delay, EventKind::acknack_generation, relation);
}

void Protocol::acknack_generation(std::uint32_t relation) {
  Relation& r = relations_[relation];
  const auto output = reader_driver_.step<reader::AckNackDue>(
      run_, r.reader, {.accepts_unmatched = accepts_unmatched_, .missing_after = r.missing},
      relation);
  if (output.send_acknack) emit_acknack(relation, false);
}

void Protocol::initial_acknack_due(std::uint32_t relation) {
  Relation& r = relations_[relation];
  initial_attempts_.attempt(r.initial, r.heartbeat_seen, relation, [&] {
    const auto output = reader_driver_.step<reader::InitialAckNackDue>(
        run_, r.reader, {.accepts_unmatched = accepts_unmatched_, .missing_after = r.missing},
        relation);
    if (output.send_initial) emit_acknack(relation, true);
  });
}

void Protocol::emit_acknack(std::uint32_t relation, bool initial) {
  ++run_.counts.acknack;
  Packet packet;
  packet.kind = PacketKind::acknack;
  packet.descriptors = descriptors_.missing(relation);
  packet.pair = relation / 2;
  packet.stream = stream_of(relation);
  packet.initial_acknack = initial;
  packet.payload_bytes = static_cast<std::uint32_t>(sedp_.acknack_bytes.count());
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
