// The way of a packet from its emission to its receptions: over the loopback to participants on the
// same host, and over its source's queue and the stages of the route to the others.
#include <algorithm>

#include "tests/oracle/cyclone_world.hpp"
#include "tests/oracle/oracle_sizes.hpp"

namespace stormproof::oracle::cyclone {

namespace {

int stage_rank(const World& w, std::size_t stage) {
  switch (w.scenario.wireless.order) {
    case model::ServiceOrder::fifo_uplink:
    case model::ServiceOrder::datagram_uplink:
      return static_cast<int>(stage);
    case model::ServiceOrder::fifo_downlink:
      return -static_cast<int>(stage);
    case model::ServiceOrder::fifo:
      return 0;
  }
  return 0;
}

void schedule_dispatch(World& w, const std::string& name) {
  Channel& channel = w.channels.at(name);
  if (channel.busy || channel.dispatch_pending) return;
  channel.dispatch_pending = true;
  Event event;
  event.kind = EventKind::dispatch;
  event.channel = name;
  schedule(w, w.now, EventClass::dispatch, event);
}

void request(World& w, std::uint64_t packet, std::size_t fragment, std::size_t stage) {
  const std::string& name = w.scenario.wireless.stages.at(stage).channel;
  w.channels.at(name).waiting[{w.now, stage_rank(w, stage), w.requests}] = {packet, stage,
                                                                            fragment};
  ++w.requests;
  schedule_dispatch(w, name);
}

void request_all(World& w, const Packet& packet, std::size_t stage) {
  for (std::size_t k = 0; k < packet.fragments.size(); ++k) request(w, packet.id, k, stage);
}

std::int64_t demand(const Packet& packet) {
  std::int64_t sum = 0;
  for (const std::int64_t bytes : packet.fragments) sum += bytes;
  return sum;
}

bool has_room(const World& w, const Participant& p, std::int64_t bytes) {
  const model::Bytes limit = w.scenario.wireless.source_queue_bytes;
  if (p.queued_bytes == 0 || limit == model::WirelessProfile::unlimited) return true;
  return p.queued_bytes + bytes <= limit.count();
}

void admit(World& w, Id i) {
  Participant& p = w.participants.at(i);
  while (!p.backlog.empty()) {
    const Packet& head = w.packets.at(p.backlog.front());
    if (!has_room(w, p, demand(head))) return;
    p.queued_bytes += demand(head);
    p.backlog.pop_front();
    if (w.scenario.wireless.fragment_request == model::FragmentRequest::sequential) {
      request(w, head.id, 0, 0);
    } else {
      request_all(w, head, 0);
    }
  }
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
  packet.id = w.packets.size();
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

void dispatch(World& w, const std::string& name) {
  Channel& channel = w.channels.at(name);
  channel.dispatch_pending = false;
  if (channel.busy || channel.waiting.empty()) return;
  const Request next = channel.waiting.begin()->second;
  channel.waiting.erase(channel.waiting.begin());
  channel.busy = true;

  const Packet& packet = w.packets.at(next.packet);
  Event event;
  event.kind = EventKind::service_finished;
  event.packet = next.packet;
  event.stage = next.stage;
  event.fragment = next.fragment;
  event.channel = name;
  const Time duration = airtime(w.scenario.wireless, next.stage, !packet.destination.has_value(),
                                packet.fragments.at(next.fragment));
  schedule(w, w.now + duration, EventClass::service, event);
}

void service_finished(World& w, const Event& event) {
  const model::WirelessProfile& wireless = w.scenario.wireless;
  w.channels.at(event.channel).busy = false;
  Packet& packet = w.packets.at(event.packet);
  ++packet.served[event.stage];

  const bool last = packet.served[event.stage] == packet.fragments.size();
  const bool first_stage = event.stage == 0;
  const bool last_stage = event.stage + 1 == wireless.stages.size();
  const bool whole_datagrams = wireless.order == model::ServiceOrder::datagram_uplink;
  const bool one_by_one = wireless.fragment_request == model::FragmentRequest::sequential;

  if (whole_datagrams && last && !last_stage) request_all(w, packet, event.stage + 1);
  if (first_stage && !last && one_by_one) request(w, packet.id, event.fragment + 1, 0);
  if (!whole_datagrams && !last_stage) request(w, packet.id, event.fragment, event.stage + 1);
  if (first_stage && last) {
    w.participants.at(packet.source).queued_bytes -= demand(packet);
    admit(w, packet.source);
  }
  if (last_stage && last && !packet.lost) schedule_receptions(w, packet, false, w.now);
  if (!w.channels.at(event.channel).waiting.empty()) schedule_dispatch(w, event.channel);
}

}  // namespace stormproof::oracle::cyclone
