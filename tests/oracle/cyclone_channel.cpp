// The way of a packet from its emission to its receptions: over the loopback to participants on the
// same host, and over its source's queue and the stages of the route (staged_channel.hpp) to the
// others.
#include "tests/oracle/cyclone_world.hpp"
#include "tests/oracle/oracle_sizes.hpp"

namespace stormproof::oracle::cyclone {

namespace {

void admit(World& w, Id i) {
  staged::admit(w, i, [&](const Packet& head) { staged::begin(w, head); });
}

// Who is to receive the packet over the loopback (same_host) or over the channel, ascending.
std::vector<Id> receivers(const World& w, const Packet& packet, bool same_host) {
  std::vector<Id> result;
  for (Id j = 0; j < w.participants.size(); ++j) {
    if (j == packet.source || packet.destination.value_or(j) != j) continue;
    if (cross_host(w, packet.source, j) != same_host) result.push_back(j);
  }
  return result;
}

void schedule_receptions(World& w, const Packet& packet, bool same_host, Time at) {
  for (const Id j : receivers(w, packet, same_host)) {
    Event event;
    event.kind = EventKind::reception;
    event.who = j;
    event.packet = packet.id;
    schedule(w, at, EventClass::service, event);
  }
}

void count(World& w, const Packet& packet, const Message& m) {
  CycloneOutcome& o = w.outcome;
  if (m.kind == MessageKind::spdp) {
    ++(packet.destination ? o.spdp_unicast : o.spdp_multicast);
  } else if (m.writer > subscriptions) {
    ++o.user_control;
  } else if (m.kind == MessageKind::heartbeat) {
    ++o.heartbeat;
  } else if (m.kind == MessageKind::acknack) {
    ++o.acknack;
  } else {
    const Id to = packet.destination.value_or(group);
    const bool first = w.delivered.insert({m.owner, m.writer, m.sample, to}).second;
    ++(first ? o.initial_data : o.repair_data);
  }
}

}  // namespace

void emit(World& w, Packet packet) {
  charge_sending(w, packet);
  packet.id = w.packets.size();
  packet.emitted = w.now;
  packet.fragments = cut_into_fragments(w.scenario.wireless, packet.payload);
  const bool on_channel = !receivers(w, packet, false).empty();
  const std::uint64_t number = w.outcome.packets;
  if (on_channel) {
    packet.lost = w.lost_packets.contains(number);
    ++w.outcome.packets;
    for (const Message& m : packet.messages) count(w, packet, m);
  }
  w.packets[packet.id] = packet;

  schedule_receptions(w, packet, true, w.now + w.scenario.deployment.loopback_delay.count());
  if (!on_channel) return;
  if (w.scenario.wireless.kind == model::ServiceKind::constant_delay) {
    Time one_way = w.scenario.wireless.one_way.count();
    for (const model::PacketDelay& delay : w.scenario.wireless.packet_delays) {
      if (delay.packet == number) one_way = delay.one_way.count();
    }
    if (!packet.lost) schedule_receptions(w, packet, false, w.now + one_way);
    return;
  }
  w.participants.at(packet.source).backlog.push_back(packet.id);
  admit(w, packet.source);
}

void request(World& w, std::uint64_t packet, std::size_t fragment, std::size_t stage) {
  staged::enqueue(w, w.scenario.wireless.stages.at(stage).channel, {packet, stage, fragment, {}});
}

void leave_source(World& w, const Packet& packet) {
  w.participants.at(packet.source).queued_bytes -= staged::demand(w, packet);
  admit(w, packet.source);
}

void arrive(World& w, const Packet& packet) {
  if (!packet.lost) schedule_receptions(w, packet, false, w.now);
}

void dispatch(World& w, const std::string& name) { staged::dispatch(w, name); }
void service_finished(World& w, const Event& event) { staged::service_finished(w, event); }

}  // namespace stormproof::oracle::cyclone
