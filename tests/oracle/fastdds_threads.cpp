// Whose threads take time for what (threads.hpp has the threads).
#include "tests/oracle/fastdds_world.hpp"

namespace stormproof::oracle::fastdds {

namespace {

Time of_submessages(const World& w, const Packet& packet) {
  const bool has_data = packet.kind == PacketKind::sedp && !packet.descriptors.empty();
  const auto count =
      has_data ? static_cast<Time>(packet.descriptors.size()) + packet.heartbeats : 1;
  return count * w.scenario.hosts->submessage.count();
}

}  // namespace

bool hears(const World& w, Id i) {
  if (!w.scenario.hosts || w.makes(WifiMistake::nobody_deaf)) return true;
  return w.now >= w.participants.at(i).hears_from;
}

std::optional<Id> who_acts(const World& w, EventClass event_class, const Event& event) {
  if (!w.scenario.hosts || event.kind == EventKind::thread_free) return std::nullopt;
  if (event.kind == EventKind::reception) {
    if (w.makes(WifiMistake::receptions_free)) return std::nullopt;
    return hears(w, event.to) ? std::optional{event.to} : std::nullopt;
  }
  if (event_class != EventClass::protocol) return std::nullopt;
  return event.from;
}

bool begins(World& w, Id i, std::uint64_t number, EventClass event_class, const Event& event) {
  return threads::begins(w, i, number, event_class, event);
}

void finish(World& w, Id i) {
  Event event;
  event.kind = EventKind::thread_free;
  event.from = i;
  threads::finish(w, event);
}

void thread_free(World& w, Id i) { threads::free_again(w, i); }

void charge_sending(World& w, const Packet& packet) {
  if (!w.scenario.hosts) return;
  w.cost += w.scenario.hosts->emission.count() + of_submessages(w, packet);
}

void charge_reception(World& w, const Packet& packet) {
  if (!w.scenario.hosts) return;
  w.cost += w.scenario.hosts->reception.count();
  if (!w.makes(WifiMistake::submessages_received_free)) w.cost += of_submessages(w, packet);
}

}  // namespace stormproof::oracle::fastdds
