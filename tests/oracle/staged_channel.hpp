// The wireless service in stages: source queue, requests, service, and what follows from its end.
// The oracles of the paper, of Fast DDS and of Cyclone DDS share it on purpose: what is sent
// differs between them, how the channel serves it does not, and three copies were one opinion. It
// shares nothing with the product, and the oracle of the paper makes mistakes in it
// (mutated_oracle_test.cpp). It knows packets and fragments, and nothing of what is in them.
//
// A world has `channels`, `packets`, `participants`, `requests`, `now` and `scenario`; beside it
// stand `schedule`, and
//   request(w, packet, fragment, stage)   asks for the service of a fragment, by `enqueue`
//   leave_source(w, packet)               the last fragment has left the source's queue
//   arrive(w, packet)                     the last fragment has been served in the last stage
#pragma once

#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <tuple>

#include "model/scenario.hpp"
#include "tests/oracle/mistake.hpp"
#include "tests/oracle/oracle_sizes.hpp"

namespace stormproof::oracle {

using Id = std::uint32_t;  // a participant or a descriptor
using Time = std::int64_t;

enum class EventClass { service = 0, protocol = 1, dispatch = 2 };

struct Request {
  std::uint64_t packet = 0;
  std::size_t stage = 0;
  std::size_t fragment = 0;
  std::string access_point;  // of listed hosts
};

struct Channel {
  bool busy = false;
  bool dispatch_pending = false;
  std::map<std::tuple<Time, int, std::uint64_t>, Request> waiting;  // (time, stage rank, number)
};

namespace staged {

template <class World>
using EventOf = typename decltype(World::queue)::mapped_type;

/// Mistakes of the channel are those of the paper's oracle; the others make none in it.
template <class World>
bool makes(const World& w, Mistake mistake) {
  if constexpr (requires { w.makes(mistake); }) {
    return w.makes(mistake);
  } else {
    return false;
  }
}

template <class World>
int rank(const World& w, std::size_t stage) {
  if (makes(w, Mistake::rank_ignored)) return 0;
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

template <class World>
void schedule_dispatch(World& w, const std::string& name) {
  Channel& channel = w.channels.at(name);
  if (channel.busy || channel.dispatch_pending) return;
  channel.dispatch_pending = true;
  EventOf<World> event;
  event.kind = decltype(event.kind)::dispatch;
  event.channel = name;
  schedule(w, w.now, EventClass::dispatch, event);
}

template <class World>
void enqueue(World& w, const std::string& name, const Request& one) {
  w.channels[name].waiting[{w.now, rank(w, one.stage), w.requests}] = one;
  ++w.requests;
  schedule_dispatch(w, name);
}

template <class World, class Packet>
void request_all(World& w, const Packet& packet, std::size_t stage) {
  const std::size_t count = packet.fragments.size();
  for (std::size_t k = 0; k < count; ++k) {
    const bool reversed = makes(w, Mistake::fragments_reversed);
    request(w, packet.id, reversed ? count - 1 - k : k, stage);
  }
}

/// Bytes of the source's queue that the packet takes.
template <class World, class Packet>
std::int64_t demand(const World& w, const Packet& packet) {
  std::int64_t sum = 0;
  for (const std::int64_t bytes : packet.fragments) sum += bytes;
  if (makes(w, Mistake::queue_drops_demand)) sum -= packet.fragments.back();
  return sum;
}

template <class World, class Participant>
bool fits(const World& w, const Participant& p, std::int64_t bytes) {
  const model::Bytes limit = w.scenario.wireless.source_queue_bytes;
  if (p.queued_bytes == 0 || limit == model::WirelessProfile::unlimited) return true;
  if (makes(w, Mistake::queue_admits_one_more)) return p.queued_bytes < limit.count();
  return p.queued_bytes + bytes <= limit.count();
}

/// Calls enter(packet) for each packet of the backlog that the source's queue takes; false if one
/// has to wait.
template <class World, class Enter>
bool admit(World& w, Id i, Enter&& enter) {
  auto& p = w.participants.at(i);
  while (!p.backlog.empty()) {
    const auto& head = w.packets.at(p.backlog.front());
    if (!fits(w, p, demand(w, head))) return false;
    p.queued_bytes += demand(w, head);
    p.backlog.pop_front();
    enter(head);
  }
  return true;
}

/// What a packet that was admitted asks for.
template <class World, class Packet>
void begin(World& w, const Packet& packet) {
  if (w.scenario.wireless.fragment_request == model::FragmentRequest::sequential) {
    request(w, packet.id, 0, 0);
  } else {
    request_all(w, packet, 0);
  }
}

/// What the channel serves next; it is busy then.
template <class World>
std::optional<Request> take_next(World& w, const std::string& name) {
  Channel& channel = w.channels.at(name);
  channel.dispatch_pending = false;
  if (channel.busy || channel.waiting.empty()) return std::nullopt;
  const Request next = channel.waiting.begin()->second;
  channel.waiting.erase(channel.waiting.begin());
  channel.busy = true;
  return next;
}

/// The end of its service.
template <class World>
EventOf<World> end_of(const World& w, const Request& one, const std::string& name) {
  EventOf<World> event;
  event.kind = decltype(event.kind)::service_finished;
  if constexpr (requires { event.from; }) {
    const auto& packet = w.packets.at(one.packet);
    event.from = packet.source;
    event.to = packet.destination.value_or(packet.source);
    event.stream = packet.stream;
  }
  event.packet = one.packet;
  event.stage = one.stage;
  event.fragment = one.fragment;
  event.channel = name;
  return event;
}

template <class World>
void dispatch(World& w, const std::string& name) {
  const std::optional<Request> next = take_next(w, name);
  if (!next) return;
  const auto& packet = w.packets.at(next->packet);
  const bool multicast = !packet.destination && !makes(w, Mistake::multicast_as_unicast);
  const Rounding rounding =
      makes(w, Mistake::airtime_rounded_down) ? Rounding::down : Rounding::to_nearest;
  const Time duration = airtime(w.scenario.wireless, next->stage, multicast,
                                packet.fragments.at(next->fragment), rounding);
  schedule(w, w.now + duration, EventClass::service, end_of(w, *next, name));
}

template <class World>
void service_finished(World& w, const EventOf<World>& event) {
  const model::WirelessProfile& wireless = w.scenario.wireless;
  w.channels.at(event.channel).busy = false;
  auto& packet = w.packets.at(event.packet);
  ++packet.served[event.stage];

  const bool last = packet.served[event.stage] == packet.fragments.size();
  const bool first_stage = event.stage == 0;
  const bool last_stage = event.stage + 1 == wireless.stages.size();
  const bool whole_datagrams = wireless.order == model::ServiceOrder::datagram_uplink;
  const bool one_by_one = wireless.fragment_request == model::FragmentRequest::sequential;

  const bool forward = !whole_datagrams && !last_stage;
  const bool early = makes(w, Mistake::forwards_first);

  if (whole_datagrams && last && !last_stage) request_all(w, packet, event.stage + 1);
  if (forward && early) request(w, packet.id, event.fragment, event.stage + 1);
  if (first_stage && !last && one_by_one) request(w, packet.id, event.fragment + 1, 0);
  if (forward && !early) request(w, packet.id, event.fragment, event.stage + 1);
  if (first_stage && last) leave_source(w, packet);
  if (last_stage && last) arrive(w, packet);
  if (w.ended) return;
  if (!w.channels.at(event.channel).waiting.empty()) schedule_dispatch(w, event.channel);
}

}  // namespace staged
}  // namespace stormproof::oracle
