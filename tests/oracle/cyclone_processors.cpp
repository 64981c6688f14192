// Whose threads take time for what (threads.hpp has the threads): what a participant receives, and
// each run of its event thread.
#include "tests/oracle/cyclone_world.hpp"

namespace stormproof::oracle::cyclone {

namespace {

Time of_messages(const World& w, const Packet& packet) {
  return static_cast<Time>(packet.messages.size()) * w.scenario.hosts->submessage.count();
}

}  // namespace

bool hears(const World& w, Id i) {
  return !w.scenario.hosts || w.now >= w.participants.at(i).hears_from;
}

std::optional<Id> who_acts(const World& w, const Event& event) {
  if (!w.scenario.hosts) return std::nullopt;
  if (event.kind == EventKind::run) return event.who;
  if (event.kind != EventKind::reception || w.makes(Mistake::receptions_free)) return std::nullopt;
  return hears(w, event.who) ? std::optional{event.who} : std::nullopt;
}

void finish(World& w, Id i) {
  Event event;
  event.kind = EventKind::thread_free;
  event.who = i;
  threads::finish(w, event);
}

void charge_sending(World& w, const Packet& packet) {
  if (!w.scenario.hosts) return;
  w.cost += w.scenario.hosts->emission.count() + of_messages(w, packet);
}

void charge_reception(World& w, const Packet& packet) {
  if (!w.scenario.hosts) return;
  w.cost += w.scenario.hosts->reception.count();
  if (!w.makes(Mistake::messages_received_free)) w.cost += of_messages(w, packet);
}

}  // namespace stormproof::oracle::cyclone
