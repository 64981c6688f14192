// The writer: HEARTBEATs, what an ACKNACK changes, the nack response and the end of suppression.
#include <algorithm>

#include "model/fastdds/protocol.hpp"

namespace stormproof::model::fastdds {

void Protocol::emit_heartbeat(std::uint32_t relation, std::int64_t bytes) {
  if (crosses(relation)) ++run_.counts.heartbeat;
  Packet packet = packet_on(PacketKind::heartbeat, relation, bytes);
  packet.detail = writers_[writer_of(relation)].created;
  send(std::move(packet));
}

void Protocol::send_heartbeat(std::uint32_t relation) {
  emit_heartbeat(relation, heartbeat_to_one_bytes);
  writers_[writer_of(relation)].budget = sedp_.piggyback_threshold_bytes.count();
}

/// To every matched reader: one message, which names its reader only if there is a single one.
void Protocol::send_periodic(std::uint32_t w) {
  Writer& writer = writers_[w];
  const std::int64_t bytes =
      writer.readers.size() == 1 ? heartbeat_to_one_bytes : heartbeat_to_many_bytes;
  for (const std::uint32_t relation : writer.readers) emit_heartbeat(relation, bytes);
  writer.budget = sedp_.piggyback_threshold_bytes.count();
}

bool Protocol::needs_heartbeat(std::uint32_t w) const {
  const Writer& writer = writers_[w];
  const bool adaptive = sedp_.heartbeat_policy == HeartbeatPolicy::adaptive;
  return std::any_of(writer.readers.begin(), writer.readers.end(), [&](std::uint32_t relation) {
    if (adaptive) return is_behind(relation);
    return (writer.created > 0 && relations_[relation].low == 0) ||
           changes_.has_unacknowledged(relation);
  });
}

bool Protocol::is_behind(std::uint32_t relation) const {
  const std::uint32_t created = writers_[writer_of(relation)].created;
  return (created > 0 && relations_[relation].low == 0) ||
         !changes_.all_acknowledged(relation, created);
}

std::vector<std::uint32_t> Protocol::unacknowledged(std::uint32_t w) const {
  std::vector<std::uint32_t> relations;
  for (const std::uint32_t relation : writers_[w].readers) {
    if (is_behind(relation)) relations.push_back(relation);
  }
  std::sort(relations.begin(), relations.end());
  return relations;
}

bool Protocol::is_unacknowledged(std::uint32_t relation) const { return is_behind(relation); }

std::uint32_t Protocol::announced(std::uint32_t w) const { return writers_[w].created; }

void Protocol::acknack_received(const Packet& packet) {
  const std::uint32_t relation = packet.relation();
  Relation& r = relations_[relation];
  if (!r.matched) return;
  if (packet.initial_acknack) {
    initial_acknack_received(relation);
    return;
  }
  const std::uint32_t w = writer_of(relation);
  const std::uint32_t base = packet.detail;
  const bool requested = changes_.acknack(relation, base, packet.descriptors);
  r.low = std::max(r.low, base);
  if (requested) {
    request(writer_shots_, writers_[w].nack_response, sedp_.nack_response_delay,
            EventKind::nack_response, w);
  } else if (!packet.descriptors.empty()) {
    heartbeats_.arm(w);
  }
  if (packet.descriptors.empty()) heartbeats_.response(w, relation, base);
}

/// The reader has seen no HEARTBEAT: the writer forgets what it took as acknowledged and answers
/// with one.
void Protocol::initial_acknack_received(std::uint32_t relation) {
  changes_.initial_acknack(relation);
  relations_[relation].low = 0;
  send_heartbeat(relation);
  heartbeats_.arm(writer_of(relation));
}

void Protocol::nack_response(std::uint32_t w) {
  Writer& writer = writers_[w];
  if (!expire(writer_shots_, writer.nack_response, w)) return;
  Participant& participant = participants_[w / 2];
  for (const std::uint32_t relation : writer.readers) {
    changes_.nack_response(relation).for_each([&](std::uint32_t d) {
      const std::uint64_t bit = std::uint64_t{1} << d % 64;
      if ((writer.enqueued[d / 64] & bit) != 0) return;
      writer.enqueued[d / 64] |= bit;
      participant.queue.push_back({stream_of(w), d});
    });
  }
  if (participant.queue.empty()) return;
  request(participant_shots_, participant.async_run, Nanoseconds{0}, EventKind::async_run, w / 2);
}

void Protocol::suppression_end(std::uint32_t relation) {
  if (!expire(relation_shots_, relations_[relation].suppression, relation)) return;
  changes_.suppression_ended(relation);
  heartbeats_.arm(writer_of(relation));
}

}  // namespace stormproof::model::fastdds
