// What a participant does not do while packets of its own wait for room in its source queue
// (`sender: stalls`), and what counts when they get it (`count_at: admission`).
#include <algorithm>

#include "tests/oracle/fastdds_world.hpp"

namespace stormproof::oracle::fastdds {

bool stalls(const World& w, Id i) {
  if (w.scenario.wireless.sender != model::Sender::stalls) return false;
  return !w.participants.at(i).backlog.empty();
}

/// Keeps the event if its participant stalls. In all events of this class `from` is who acts.
bool is_held(World& w, const Event& event) {
  if (!stalls(w, event.from)) return false;
  if (event.kind == EventKind::creation && w.makes(WifiMistake::creations_go_on)) return false;
  const bool answers =
      event.kind == EventKind::acknack_generation || event.kind == EventKind::initial_acknack;
  if (answers && w.makes(WifiMistake::acknacks_go_on)) return false;
  std::vector<Event>& held = w.participants.at(event.from).held;
  const auto place = w.makes(WifiMistake::held_again_first) ? held.begin() : held.end();
  held.insert(place, event);
  return true;
}

void wake(World& w, Id i) {
  Participant& p = w.participants.at(i);
  if (!p.backlog.empty() && !w.makes(WifiMistake::held_until_next_packet)) return;
  const std::vector<Event> held = p.held;
  p.held.clear();
  for (const Event& event : held) schedule(w, w.now, EventClass::protocol, event);
}

void count_admitted(World& w, const Packet& packet) {
  switch (packet.kind) {
    case PacketKind::spdp:
      ++(packet.destination ? w.admitted.spdp_unicast : w.admitted.spdp_multicast);
      return;
    case PacketKind::sedp:
      w.admitted.initial_data += packet.initial_data;
      w.admitted.repair_data += packet.repair_data;
      w.admitted.heartbeat += packet.heartbeats;
      return;
    case PacketKind::acknack:
      ++w.admitted.acknack;
      return;
    case PacketKind::control_heartbeat:
    case PacketKind::control_acknack:
      ++w.admitted.user_control;
      return;
    case PacketKind::lookup:
      w.admitted.lookup += static_cast<std::int64_t>(packet.samples.size());
      w.admitted.user_control += packet.heartbeats;
      return;
    default:
      return;  // of and to a server: no rule counts them so
  }
}

}  // namespace stormproof::oracle::fastdds
