// What a writer puts on the air: HEARTBEATs of their own, DATA grouped into packets, and the
// piggyback HEARTBEATs that the byte budget triggers on the way. The storm of the paper is made
// here.
#include "tests/oracle/oracle_world.hpp"

namespace stormproof::oracle {

namespace {

Packet empty_packet(Id i, Id j, int s, bool repair) {
  Packet packet;
  packet.kind = PacketKind::sedp;
  packet.source = i;
  packet.destination = j;
  packet.stream = s;
  packet.repair = repair;
  return packet;
}

// Whether a descriptor of z bytes may join a packet that already holds one.
bool joins(const World& w, const Packet& packet, std::int64_t z) {
  if (w.sedp.grouping == model::Grouping::single) return false;
  const std::int64_t shared =
      w.makes(Mistake::grouping_forgets_header) ? 0 : w.sedp.shared_header_bytes.count();
  const std::int64_t payload = packet.payload + z - shared;
  return payload <= grouping_limit(w.sedp);
}

void count_data(World& w, Relation& r, Id d) {
  if (r.generated.at(d)) {
    ++w.outcome.repair_data;
  } else {
    ++w.outcome.initial_data;
  }
  r.generated.at(d) = true;
}

// Charges the bytes against the writer's budget. Returns whether it is used up; it is then full
// again.
bool charge(World& w, Id i, int s, std::int64_t added) {
  Participant& p = w.participants.at(i);
  Writer& writer = w.writers.at({i, s});
  switch (w.sedp.piggyback) {
    case model::Piggyback::cumulative:
      p.sent_bytes += added;
      writer.budget -= p.sent_bytes;
      break;
    case model::Piggyback::linear:
      writer.budget -= added;
      break;
    case model::Piggyback::group:  // of Fast DDS
    case model::Piggyback::off:
      return false;
  }
  if (w.makes(Mistake::budget_ends_at_zero) ? writer.budget > 0 : writer.budget >= 0) return false;
  writer.budget = w.sedp.piggyback_threshold_bytes.count();
  ++w.outcome.piggybacks;
  return true;
}

// A HEARTBEAT to all open readers; the packet comes back empty if it had to go first.
Packet piggyback(World& w, Packet packet) {
  const Id i = packet.source;
  const int s = packet.stream;
  const bool charged = !w.makes(Mistake::piggyback_uncharged);
  std::vector<Id> readers = open_readers(w, i, s);
  if (w.makes(Mistake::piggyback_to_one)) readers = {*packet.destination};
  if (readers.size() == 1) {
    const std::int64_t bytes = w.sedp.piggyback_heartbeat_bytes.count();
    ++w.outcome.heartbeat;
    packet.payload += bytes;
    packet.carries_heartbeat = true;
    if (charged) w.participants.at(i).sent_bytes += bytes;
    return packet;
  }
  emit(w, packet);
  if (charged) w.participants.at(i).sent_bytes += w.sedp.heartbeat_bytes.count();
  for (const Id j : readers) generate_heartbeat(w, i, j, s);
  return empty_packet(i, *packet.destination, s, packet.repair);
}

}  // namespace

void generate_heartbeat(World& w, Id i, Id j, int s) {
  ++w.outcome.heartbeat;
  if (!w.makes(Mistake::heartbeat_keeps_budget)) {
    w.writers.at({i, s}).budget = w.sedp.piggyback_threshold_bytes.count();
  }
  if (w.makes(Mistake::charge_starts_anew)) w.participants.at(i).sent_bytes = 0;
  Packet packet = empty_packet(i, j, s, false);
  packet.payload = w.sedp.heartbeat_bytes.count();
  packet.carries_heartbeat = true;
  const Writer& writer = w.writers.at({i, s});
  packet.announces =
      w.makes(Mistake::heartbeats_announce_start) ? writer.written_at_start : writer.written;
  emit(w, packet);
}

void generate_data(World& w, Id i, Id j, int s, const std::vector<Id>& descriptors, bool repair) {
  Relation& r = relation(w, i, j, s);
  Packet packet = empty_packet(i, j, s, repair);
  for (const Id d : descriptors) {
    const std::int64_t z = descriptor_bytes(w.scenario, s, d);
    if (!packet.descriptors.empty() && !joins(w, packet, z)) {
      emit(w, packet);
      packet = empty_packet(i, j, s, repair);
    }
    const std::int64_t shared = w.sedp.shared_header_bytes.count();
    const std::int64_t added = packet.descriptors.empty() ? z : z - shared;
    packet.payload += added;
    packet.descriptors.push_back(d);
    count_data(w, r, d);
    if (charge(w, i, s, added)) packet = piggyback(w, packet);
  }
  if (!packet.descriptors.empty()) emit(w, packet);
}

}  // namespace stormproof::oracle
