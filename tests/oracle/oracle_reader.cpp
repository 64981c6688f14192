// The receiving end: what a participant does with a packet that reaches it, and the ACKNACKs that
// its readers send. The run completes here, with the last missing descriptor.
#include <algorithm>

#include "tests/oracle/oracle_world.hpp"

namespace stormproof::oracle {

namespace {

void take_data(World& w, Relation& r, const Packet& packet) {
  for (const Id d : packet.descriptors) {
    if (r.received.at(d)) continue;
    r.received.at(d) = true;
    if (is_asked_for(w, packet.source, *packet.destination)) --w.missing;
    if (w.missing == 0) {
      w.outcome.completed = true;
      w.outcome.t_disc_ns = w.now;
      w.ended = completion_ends(w) && w.now >= w.settled;
      if (w.ended) return;
    }
  }
}

void receive_sedp(World& w, Id j, const Packet& packet) {
  Relation& r = relation(w, packet.source, j, packet.stream);
  const bool strict = w.sedp.unmatched == model::Unmatched::drop &&
                      w.sedp.relation_opening == model::RelationOpening::each_side;
  if (strict && !r.reader_open) return;
  for (const Id d : packet.descriptors) r.known = std::max(r.known, d + 1);
  r.known = std::max(r.known, packet.announces);
  take_data(w, r, packet);
  if (w.ended || !packet.carries_heartbeat) return;
  r.heartbeat_seen = true;
  if (w.makes(Mistake::one_acknack_pending) && r.pending_acknacks > 0) return;
  ++r.pending_acknacks;
  Event event;
  event.kind = EventKind::acknack_generation;
  event.from = j;
  event.to = packet.source;
  event.stream = packet.stream;
  const Time delay = w.sedp.heartbeat_response_delay.count();
  schedule(w, w.now + delay, EventClass::protocol, event);
}

Packet acknack_packet(World& w, Id j, Id i, int s) {
  Packet packet;
  packet.kind = PacketKind::acknack;
  packet.source = j;
  packet.destination = i;
  packet.stream = s;
  packet.payload = w.sedp.acknack_bytes.count();
  const Relation& r = relation(w, i, j, s);
  for (Id d = 0; d < r.known; ++d) {
    if (!r.received.at(d)) packet.bitmap.insert(d);
  }
  packet.announces = r.known;
  return packet;
}

// The same ACKNACK, listing what is missing now.
Packet renewed(World& w, Packet packet) {
  packet.bitmap = acknack_packet(w, packet.source, *packet.destination, packet.stream).bitmap;
  return packet;
}

void receive_at(World& w, Id j, const Packet& packet) {
  if (!started(w, j) || !is_heard(w, packet, j)) return;
  switch (packet.kind) {
    case PacketKind::spdp:
      receive_spdp(w, j, packet.source);
      break;
    case PacketKind::sedp:
      receive_sedp(w, j, packet);
      break;
    case PacketKind::acknack:
      receive_acknack(w, w.makes(Mistake::bitmap_not_snapshot) ? renewed(w, packet) : packet);
      break;
  }
  const bool renews = packet.kind == PacketKind::spdp || !w.makes(Mistake::lease_renewed_by_spdp);
  if (renews) heard(w, j, packet.source);
}

}  // namespace

void receive(World& w, const Packet& packet) {
  if (packet.destination.has_value()) {
    receive_at(w, *packet.destination, packet);
    return;
  }
  for (Id j = 0; j < w.participants.size() && !w.ended; ++j) {
    if (cross_host(w, packet.source, j)) receive_at(w, j, packet);
  }
}

void generate_acknack(World& w, Id j, Id i, int s) {
  --relation(w, i, j, s).pending_acknacks;
  Packet packet = acknack_packet(w, j, i, s);
  const std::int64_t count = relation(w, i, j, s).known;
  const std::int64_t words =
      w.makes(Mistake::acknack_words_down) ? count / 32 : ceil_div(count, 32);
  if (!packet.bitmap.empty()) packet.payload += 4 * words;
  ++w.outcome.acknack;
  emit(w, packet);
}

void initial_acknack(World& w, Id j, Id i, int s, Time delay) {
  if (relation(w, i, j, s).heartbeat_seen && !w.makes(Mistake::initial_never_ends)) return;
  Packet packet = acknack_packet(w, j, i, s);
  packet.initial = true;
  ++w.outcome.acknack;
  emit(w, packet);
  Event again;
  again.kind = EventKind::initial_acknack;
  again.from = j;
  again.to = i;
  again.stream = s;
  bool stays = w.sedp.initial_acknack_interval == model::InitialAckNackInterval::constant;
  if (w.makes(Mistake::initial_not_doubled)) stays = true;
  if (w.makes(Mistake::initial_always_doubled)) stays = false;
  again.number = stays ? delay : 2 * delay;
  schedule(w, w.now + again.number, EventClass::protocol, again);
}

}  // namespace stormproof::oracle
