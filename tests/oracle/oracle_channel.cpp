// From a packet's emission over its source's queue and the stages of the route
// (staged_channel.hpp) to its reception, or over a network with a constant delay.
#include "tests/oracle/oracle_world.hpp"

namespace stormproof::oracle {

namespace {

void admit(World& w, Id i) {
  staged::admit(w, i, [&](const Packet& head) { staged::begin(w, head); });
}

void deliver_after_delay(World& w, const Packet& packet) {
  Event event;
  event.from = packet.source;
  event.to = packet.destination.value_or(packet.source);
  event.stream = packet.stream;
  event.packet = packet.id;
  Time leaves_after = 0;
  Time one_way = w.scenario.wireless.one_way.count();
  for (const model::PacketDelay& delay : w.scenario.wireless.packet_delays) {
    if (delay.packet != packet.id) continue;
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
  packet.id = w.outcome.packets;
  packet.emitted = w.now;
  ++w.outcome.packets;
  packet.lost = w.lost_packets.contains(packet.id) && !w.makes(Mistake::loss_ignored);
  packet.fragments = cut_into_fragments(w.scenario.wireless, packet.payload);
  w.packets[packet.id] = packet;
  if (w.scenario.wireless.kind == model::ServiceKind::constant_delay) {
    deliver_after_delay(w, packet);
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
  if (w.makes(Mistake::admits_first)) admit(w, packet.source);
  source_completion(w, packet);
  admit(w, packet.source);
}

void arrive(World& w, const Packet& packet) {
  if (!packet.lost) receive(w, packet);
}

void dispatch(World& w, const std::string& name) { staged::dispatch(w, name); }
void service_finished(World& w, const Event& event) { staged::service_finished(w, event); }

}  // namespace stormproof::oracle
