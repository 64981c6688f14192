// The writer side of a relation: what an ACKNACK changes, when repair DATA is made, and how
// suppression ends.
#include <algorithm>

#include "model/paper/protocol.hpp"

namespace stormproof::model::paper {

void Protocol::acknack_received(const Packet& packet) {
  const std::uint32_t relation = packet.relation();
  Relation& r = relations_[relation];
  if (r.open_rank == no_rank) return;
  if (packet.initial_acknack && sedp_.initial_acknack != InitialAckNackReply::bitmap) {
    if (sedp_.initial_acknack == InitialAckNackReply::heartbeat) send_heartbeat(relation);
    return;
  }
  const auto effect =
      descriptors_.acknack(relation, packet.descriptors, sedp_.acknowledge == Acknowledge::prefix);
  // A mutated table may acknowledge a descriptor twice.
  const std::uint32_t acknowledged = std::min(effect.acknowledged, r.unacknowledged);
  r.unacknowledged -= acknowledged;
  if (acknowledged > 0 && r.unacknowledged == 0) {
    Writer& writer = writers_[writer_of(relation)];
    --writer.unacknowledged;
    const std::uint32_t peer = relation / 2 - run_.topology.first_pair(ends(relation).source);
    writer.waiting_readers[peer / 64] &= ~(std::uint64_t{1} << peer % 64);
  }
  if (effect.requested > 0) {
    run_.schedule(run_.now + sedp_.nack_response_delay, EventKind::repair_generation, relation);
  }
  if (packet.descriptors.empty()) {
    heartbeats_.response(writer_of(relation), relation, announced(writer_of(relation)));
  }
}

void Protocol::repair_generation(std::uint32_t relation) {
  const DescriptorSet requested = descriptors_.repair_due(relation);
  if (!requested.empty()) generate_data(relation, requested, true);
}

void Protocol::source_completed(const Packet& packet) {
  if (!packet.from_repair) return;
  descriptors_.repair_sent(packet.relation(), packet.descriptors);
  run_.schedule(run_.now + sedp_.nack_suppression_duration, EventKind::suppression_end,
                packet.relation());
}

void Protocol::suppression_end(std::uint32_t relation) {
  if (descriptors_.suppression_ended(relation) > 0) {
    heartbeats_.suppression_ended(writer_of(relation));
  }
}

}  // namespace stormproof::model::paper
