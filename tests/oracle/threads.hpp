// Threads that take time: one for each participant, as many at once on a host as it has cores, and
// a line for each (specs/guide/fleet.md, "Processors"). The oracles of Fast DDS and of Cyclone DDS
// share it on purpose, as they share the channel: who acts when, and what is sent, each says for
// itself. It shares nothing with the product.
//
// A world has `participants` with a `thread` and a `host`, `queues`, `running`, `cost`,
// `insertions`, `now` and `scenario`; beside it stands `schedule`.
#pragma once

#include <cstdint>
#include <deque>
#include <optional>
#include <random>
#include <utility>

#include "tests/oracle/staged_channel.hpp"

namespace stormproof::oracle::threads {

template <class Event>
struct Thread {
  std::deque<std::pair<EventClass, Event>> line;
  bool runs = false;  // on a core
  bool queues = false;
  std::optional<std::uint64_t> begins_with;  // number of an event
};

/// Mistakes of threads are those of Fast DDS's oracle with listed hosts; the others make none.
template <class World>
bool makes(const World& w, WifiMistake mistake) {
  if constexpr (requires { w.makes(mistake); }) {
    return w.makes(mistake);
  } else {
    return false;
  }
}

/// From when on each participant hears what reaches it, if it is not deaf: `opens(participant)`.
template <class World, class Opens>
void draw_deafness(World& w, Opens&& opens) {
  if (!w.scenario.hosts) return;
  const auto& hosts = *w.scenario.hosts;
  std::mt19937_64 of_deafness{hosts.deaf_seed};
  const auto values = static_cast<std::uint64_t>((hosts.deaf_max - hosts.deaf_min).count() + 1);
  for (auto& p : w.participants) {
    p.hears_from = opens(p) + hosts.deaf_min.count();
    p.hears_from += static_cast<Time>(of_deafness() % values);
  }
}

/// Cores go to those who have waited longest.
template <class World>
void give_cores(World& w, Id host) {
  std::deque<Id>& queue = w.queues[host];
  const std::uint32_t cores = w.scenario.hosts->cores;
  while (!queue.empty() &&
         (w.running[host] < cores || makes(w, WifiMistake::any_number_of_cores))) {
    auto& thread = w.participants.at(queue.front()).thread;
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

template <class World, class Event>
bool begins(World& w, Id i, std::uint64_t number, EventClass event_class, const Event& event) {
  auto& thread = w.participants.at(i).thread;
  const Id host = w.participants.at(i).host;
  w.cost = 0;
  if (thread.begins_with == number) {
    thread.begins_with.reset();
    return true;
  }
  thread.line.emplace_back(event_class, event);
  if (thread.runs) return false;
  const std::uint32_t cores = w.scenario.hosts->cores;
  const bool has_core = w.running[host] < cores || makes(w, WifiMistake::any_number_of_cores);
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

/// `free` says that the thread of its participant is free again.
template <class World, class Event>
void finish(World& w, const Event& free) {
  schedule(w, w.now + w.cost, EventClass::protocol, free);
}

template <class World>
void free_again(World& w, Id i) {
  auto& thread = w.participants.at(i).thread;
  const Id host = w.participants.at(i).host;
  thread.runs = false;
  --w.running[host];
  if (!thread.line.empty()) {
    w.queues[host].push_back(i);
    thread.queues = true;
  }
  give_cores(w, host);
}

}  // namespace stormproof::oracle::threads
