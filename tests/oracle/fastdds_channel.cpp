// The way of a packet from its emission to its receptions: over the loopback to participants on the
// same host, and over its source's queue and the stages of the route to the others. Nothing here
// looks at what is in a packet.
#include <algorithm>

#include "tests/oracle/fastdds_world.hpp"
#include "tests/oracle/oracle_sizes.hpp"

namespace stormproof::oracle::fastdds {

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

bool by_unit(const World& w) { return w.scenario.wireless.service == model::ServedBy::unit; }

void request(World& w, std::uint64_t packet, std::size_t fragment, std::size_t stage) {
  if (by_unit(w)) return request_unit(w, w.packets.at(packet), fragment, stage > 0);
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

bool fits(const World& w, const Participant& p, std::int64_t bytes) {
  const model::Bytes limit = w.scenario.wireless.source_queue_bytes;
  if (p.queued_bytes == 0 || limit == model::WirelessProfile::unlimited) return true;
  return p.queued_bytes + bytes <= limit.count();
}

void admit(World& w, Id i) {
  Participant& p = w.participants.at(i);
  while (!p.backlog.empty()) {
    const Packet& head = w.packets.at(p.backlog.front());
    if (!fits(w, p, demand(head))) return;
    p.queued_bytes += demand(head);
    p.backlog.pop_front();
    count_admitted(w, head);
    if (w.makes(WifiMistake::held_until_next_packet)) wake(w, i);
    if (w.scenario.wireless.fragment_request == model::FragmentRequest::sequential) {
      request(w, head.id, 0, 0);
    } else {
      request_all(w, head, 0);
    }
  }
  wake(w, i);
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
  std::vector<Id> ids = receivers(w, packet, same_host);
  if (w.makes(Mistake::receptions_reversed)) std::reverse(ids.begin(), ids.end());
  for (const Id j : ids) {
    Event event = make_event(EventKind::reception, packet.source, j, packet.stream);
    event.packet = packet.id;
    schedule(w, at, EventClass::service, event);
  }
}

}  // namespace

void leave_source(World& w, const Packet& packet) {
  w.participants.at(packet.source).queued_bytes -= demand(packet);
  admit(w, packet.source);
}

void arrive(World& w, const Packet& packet) {
  if (!packet.lost) schedule_receptions(w, packet, false, w.now);
}

void emit(World& w, Packet packet) {
  packet.id = w.packets.size();
  packet.fragments = cut_into_fragments(w.scenario.wireless, packet.payload);
  const bool on_channel = packet.to_nobody || !receivers(w, packet, false).empty();
  const std::uint64_t number = w.outcome.packets;
  if (on_channel) packet.lost = w.lost_packets.contains(number);
  if (on_channel || w.makes(Mistake::loopback_takes_a_number)) ++w.outcome.packets;
  w.packets[packet.id] = packet;

  const Time loopback =
      w.makes(Mistake::loopback_without_delay) ? 0 : w.scenario.deployment.loopback_delay.count();
  schedule_receptions(w, packet, true, w.now + loopback);
  if (!on_channel) return;
  if (w.scenario.wireless.kind == model::ServiceKind::constant_delay) {
    Time one_way = w.scenario.wireless.one_way.count();
    for (const model::PacketDelay& delay : w.scenario.wireless.packet_delays) {
      if (delay.packet == number) one_way = delay.one_way.count();
    }
    count_admitted(w, packet);
    if (!packet.lost) schedule_receptions(w, packet, false, w.now + one_way);
    return;
  }
  w.participants.at(packet.source).backlog.push_back(packet.id);
  admit(w, packet.source);
}

void dispatch(World& w, const std::string& name) {
  if (by_unit(w)) return dispatch_unit(w);
  Channel& channel = w.channels.at(name);
  channel.dispatch_pending = false;
  if (channel.busy || channel.waiting.empty()) return;
  const Request next = channel.waiting.begin()->second;
  channel.waiting.erase(channel.waiting.begin());
  channel.busy = true;

  const Packet& packet = w.packets.at(next.packet);
  const bool multicast = !packet.destination.has_value();
  Event event = make_event(EventKind::service_finished, packet.source,
                           packet.destination.value_or(packet.source), packet.stream);
  event.packet = next.packet;
  event.stage = next.stage;
  event.fragment = next.fragment;
  event.channel = name;
  const std::int64_t bytes = packet.fragments.at(next.fragment);
  const Time duration = airtime(w.scenario.wireless, next.stage, multicast, bytes);
  schedule(w, w.now + duration, EventClass::service, event);
}

void service_finished(World& w, const Event& event) {
  if (by_unit(w)) return unit_finished(w);
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
  if (first_stage && last) leave_source(w, packet);
  if (last_stage && last) arrive(w, packet);
  if (!w.channels.at(event.channel).waiting.empty()) schedule_dispatch(w, event.channel);
}

}  // namespace stormproof::oracle::fastdds
