// Threads that take time: one for each participant, as many at once on a host as it has cores, and
// a line for each.
#include <algorithm>

#include "tests/oracle/fastdds_world.hpp"

namespace stormproof::oracle::fastdds {

namespace {

Time of_submessages(const World& w, const Packet& packet) {
  const bool has_data = packet.kind == PacketKind::sedp && !packet.descriptors.empty();
  const auto count =
      has_data ? static_cast<Time>(packet.descriptors.size()) + packet.heartbeats : 1;
  return count * w.scenario.hosts->submessage.count();
}

/// Cores go to those who have waited longest.
void give_cores(World& w, Id host) {
  std::deque<Id>& queue = w.queues[host];
  const std::uint32_t cores = w.scenario.hosts->cores;
  while (!queue.empty() && (w.running[host] < cores || w.makes(WifiMistake::any_number_of_cores))) {
    Thread& thread = w.participants.at(queue.front()).thread;
    queue.pop_front();
    thread.queues = false;
    thread.runs = true;
    ++w.running[host];
    const auto [event_class, event] = thread.line.front();
    thread.line.pop_front();
    thread.begins_with = w.insertions;
    schedule(w, w.now, event_class, event);
  }
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
  Thread& thread = w.participants.at(i).thread;
  const Id host = w.participants.at(i).host;
  w.cost = 0;
  if (thread.begins_with == number) {
    thread.begins_with.reset();
    return true;
  }
  thread.line.emplace_back(event_class, event);
  if (thread.runs) return false;
  const std::uint32_t cores = w.scenario.hosts->cores;
  const bool has_core = w.running[host] < cores || w.makes(WifiMistake::any_number_of_cores);
  if (!thread.queues && has_core) {
    thread.line.pop_back();
    thread.runs = true;
    ++w.running[host];
    return true;
  }
  if (!thread.queues) w.queues[host].push_back(i);
  thread.queues = true;
  return false;
}

void finish(World& w, Id i) {
  Event event;
  event.kind = EventKind::thread_free;
  event.from = i;
  schedule(w, w.now + w.cost, EventClass::protocol, event);
}

void thread_free(World& w, Id i) {
  Thread& thread = w.participants.at(i).thread;
  const Id host = w.participants.at(i).host;
  thread.runs = false;
  --w.running[host];
  if (!thread.line.empty()) {
    w.queues[host].push_back(i);
    thread.queues = true;
  }
  give_cores(w, host);
}

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
