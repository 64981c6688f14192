// The wireless service: from a packet's emission over its source's queue and the stages of the
// route to its reception. It knows packets and fragments, and nothing of what is in them.
#include "tests/oracle/oracle_world.hpp"

namespace stormproof::oracle {

namespace {

int stage_rank(const World& w, std::size_t stage) {
  if (w.makes(Mistake::rank_ignored)) return 0;
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
  const std::size_t count = packet.fragments.size();
  for (std::size_t k = 0; k < count; ++k) {
    const bool reversed = w.makes(Mistake::fragments_reversed);
    request(w, packet.number, reversed ? count - 1 - k : k, stage);
  }
}

std::int64_t demand(const World& w, const Packet& packet) {
  std::int64_t sum = 0;
  for (const std::int64_t bytes : packet.fragments) sum += bytes;
  if (w.makes(Mistake::queue_drops_demand)) sum -= packet.fragments.back();
  return sum;
}

bool fits(const World& w, const Participant& p, std::int64_t bytes) {
  const model::Bytes limit = w.scenario.wireless.source_queue_bytes;
  if (p.queued_bytes == 0 || limit == model::WirelessProfile::unlimited) return true;
  if (w.makes(Mistake::queue_admits_one_more)) return p.queued_bytes < limit.count();
  return p.queued_bytes + bytes <= limit.count();
}

void admit(World& w, Id i) {
  Participant& p = w.participants.at(i);
  while (!p.backlog.empty()) {
    const Packet& head = w.packets.at(p.backlog.front());
    if (!fits(w, p, demand(w, head))) return;
    p.queued_bytes += demand(w, head);
    p.backlog.pop_front();
    if (w.scenario.wireless.fragment_request == model::FragmentRequest::sequential) {
      request(w, head.number, 0, 0);
    } else {
      request_all(w, head, 0);
    }
  }
}

void deliver_after_delay(World& w, const Packet& packet) {
  Event event;
  event.from = packet.source;
  event.to = packet.destination.value_or(packet.source);
  event.stream = packet.stream;
  event.packet = packet.number;
  Time leaves_after = 0;
  Time one_way = w.scenario.wireless.one_way.count();
  for (const model::PacketDelay& delay : w.scenario.wireless.packet_delays) {
    if (delay.packet != packet.number) continue;
    leaves_after = delay.leaves_after.count();
    one_way = delay.one_way.count();
  }
  event.kind = EventKind::source_completion;
  schedule(w, w.now + leaves_after, EventClass::protocol, event);
  event.kind = EventKind::delayed_reception;
  schedule(w, w.now + one_way, EventClass::service, event);
}

}  // namespace

void emit(World& w, Packet packet) {
  packet.number = w.outcome.packets;
  packet.emitted = w.now;
  ++w.outcome.packets;
  packet.lost = w.lost_packets.contains(packet.number) && !w.makes(Mistake::loss_ignored);
  packet.fragments = cut_into_fragments(w.scenario.wireless, packet.payload);
  w.packets[packet.number] = packet;
  if (w.scenario.wireless.kind == model::ServiceKind::constant_delay) {
    deliver_after_delay(w, packet);
    return;
  }
  w.participants.at(packet.source).backlog.push_back(packet.number);
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
  const bool multicast = !packet.destination.has_value() && !w.makes(Mistake::multicast_as_unicast);
  Event event;
  event.kind = EventKind::service_finished;
  event.from = packet.source;
  event.to = packet.destination.value_or(packet.source);
  event.stream = packet.stream;
  event.packet = next.packet;
  event.stage = next.stage;
  event.fragment = next.fragment;
  event.channel = name;
  const std::int64_t bytes = packet.fragments.at(next.fragment);
  const Rounding rounding =
      w.makes(Mistake::airtime_rounded_down) ? Rounding::down : Rounding::to_nearest;
  const Time duration = airtime(w.scenario.wireless, next.stage, multicast, bytes, rounding);
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

  const bool forward = !whole_datagrams && !last_stage;
  const bool early = w.makes(Mistake::forwards_first);

  if (whole_datagrams && last && !last_stage) request_all(w, packet, event.stage + 1);
  if (forward && early) request(w, packet.number, event.fragment, event.stage + 1);
  if (first_stage && !last && one_by_one) request(w, packet.number, event.fragment + 1, 0);
  if (forward && !early) request(w, packet.number, event.fragment, event.stage + 1);
  if (first_stage && last) {
    w.participants.at(packet.source).queued_bytes -= demand(w, packet);
    if (w.makes(Mistake::admits_first)) admit(w, packet.source);
    source_completion(w, packet);
    admit(w, packet.source);
  }
  if (last_stage && last && !packet.lost) {
    receive(w, packet);
    if (w.ended) return;
  }
  if (!w.channels.at(event.channel).waiting.empty()) schedule_dispatch(w, event.channel);
}

}  // namespace stormproof::oracle
