// The receiving end: what a participant does with a packet that reaches it, and the ACKNACKs that
// its built-in readers send. The run completes here, with the last missing descriptor.
#include <algorithm>

#include "tests/oracle/fastdds_world.hpp"

namespace stormproof::oracle::fastdds {

namespace {

constexpr std::int64_t bitmap_payload = 4;

void take_data(World& w, Relation& r, const Packet& packet, Id j) {
  for (const Id d : packet.descriptors) {
    const bool counts = !with_types(w) || w.makes(Mistake::complete_when_received);
    if (counts && !r.received.at(d) && is_needed(w, packet.source, j, packet.stream, d)) {
      --w.missing;
    }
    r.received.at(d) = true;
    if (!w.makes(Mistake::data_announces_nothing)) r.announced = std::max(r.announced, d + 1);
  }
  note_completion(w);
}

void notify_in_order(World& w, Relation& r, Id i, Id j, int s) {
  const Id ahead = w.makes(Mistake::notified_late) ? 1 : 0;
  while (r.handed_over + ahead < r.received.size() && r.received.at(r.handed_over + ahead)) {
    ++r.handed_over;
    hand_over(w, i, j, s, r.handed_over - 1);
  }
}

void receive_sedp(World& w, Id j, const Packet& packet) {
  const Id i = packet.source;
  const int s = packet.stream;
  Relation& r = relation(w, i, j, s);
  if (!r.reader_open) return;
  const std::vector<bool> before = r.received;
  take_data(w, r, packet, j);
  if (w.ended) return;
  notify_in_order(w, r, i, j, s);
  ask_for_all(w, j, i);
  if (w.server) {
    std::vector<Id> fresh;
    for (Id d = 0; d < before.size(); ++d) {
      if (r.received.at(d) && !before.at(d)) fresh.push_back(d);
    }
    server_learns(w, i, s, fresh);
  }
  if (!packet.announced.has_value()) return;
  r.heartbeat_seen = true;
  r.announced = std::max(r.announced, *packet.announced);
  if (r.acknack_pending && !w.makes(Mistake::acknack_per_heartbeat)) return;
  r.acknack_pending = true;
  schedule_after(w, sedp(w, j).heartbeat_response_delay,
                 make_event(EventKind::acknack_generation, j, i, s));
}

Packet acknack_packet(Id j, Id i, int s) {
  Packet packet;
  packet.kind = PacketKind::acknack;
  packet.source = j;
  packet.destination = i;
  packet.stream = s;
  packet.payload = acknack_payload;
  return packet;
}

void send_acknack(World& w, const Packet& packet) {
  if (cross_host(w, packet.source, *packet.destination)) ++w.outcome.acknack;
  emit(w, packet);
}

void take_in(World& w, const Packet& packet, Id j) {
  switch (packet.kind) {
    case PacketKind::spdp:
      return receive_spdp(w, j, packet.source);
    case PacketKind::sedp:
      return receive_sedp(w, j, packet);
    case PacketKind::acknack:
      return receive_acknack(w, packet);
    case PacketKind::control_heartbeat:
      return receive_control_heartbeat(w, packet);
    case PacketKind::control_acknack:
      return receive_control_acknack(w, packet);
    case PacketKind::lookup:
      return receive_samples(w, packet);
    case PacketKind::registration:
      return receive_registration(w, packet);
    case PacketKind::registration_heartbeat:
      return receive_registration_heartbeat(w, packet.source);
    case PacketKind::registration_acknack:
      return receive_registration_acknack(w, packet);
    case PacketKind::relayed:
      return receive_relayed(w, packet);
    case PacketKind::learning_acknack:
      return receive_learning_acknack(w, packet);
  }
}

}  // namespace

void note_completion(World& w) {
  w.ended = ends_complete(w);
  if (w.missing > 0 || w.outcome.completed) return;
  w.outcome.completed = true;
  w.outcome.t_disc_ns = w.now;
}

void receive(World& w, const Packet& packet, Id j) {
  if (!started(w, j) || !is_heard(w, packet, j)) return;
  take_in(w, packet, j);
  heard(w, j, packet.source);
}

void generate_acknack(World& w, Id j, Id i, int s) {
  Relation& r = relation(w, i, j, s);
  r.acknack_pending = false;
  Packet packet = acknack_packet(j, i, s);
  while (packet.base < r.received.size() && r.received.at(packet.base)) ++packet.base;
  for (Id d = packet.base; d < r.announced; ++d) {
    if (!r.received.at(d)) packet.bitmap.insert(d);
  }
  if (!packet.bitmap.empty()) packet.payload += bitmap_payload;
  send_acknack(w, packet);
}

void initial_acknack(World& w, Id j, Id i, int s, Time delay) {
  if (relation(w, i, j, s).heartbeat_seen) return;
  Packet packet = acknack_packet(j, i, s);
  packet.initial = true;
  send_acknack(w, packet);
  Event again = make_event(EventKind::initial_acknack, j, i, s);
  const bool stays = sedp(w, j).initial_acknack_interval == model::InitialAckNackInterval::constant;
  again.number = stays && !w.makes(Mistake::initial_always_doubled) ? delay : 2 * delay;
  schedule_after(w, model::Nanoseconds{again.number}, again);
}

}  // namespace stormproof::oracle::fastdds
