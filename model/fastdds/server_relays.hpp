// The server's writers at work: what the routine has noted and lists, what the sending thread makes
// of it, what ACKNACKs do to it, and what clients make of what they are sent. The bodies of
// ServerSteps; everything goes to one reader at a time, with a HEARTBEAT that announces all that
// there is.
#pragma once

#include <algorithm>
#include <map>
#include <utility>
#include <vector>

#include "model/fastdds/server_steps.hpp"

namespace stormproof::model::fastdds {

template <class Host>
bool ServerSteps<Host>::take_in(const Packet& packet) {
  const Number relation = relay::count * packet.pair + packet.detail;
  const auto run = [&]<class P>(P, Number n) {
    host().template run<fsm::composition::Received<P>>(n, &packet);
    return true;
  };
  switch (packet.kind) {
    case PacketKind::registration:
      return run(server::Registration{}, packet.pair);
    case PacketKind::registration_heartbeat:
      return run(server::RegistrationHeartbeat{}, packet.pair);
    case PacketKind::registration_acknack:
      return run(server::RegistrationAckNack{}, packet.pair);
    case PacketKind::relayed_acknack:
      return run(server::RelayedAckNack{}, relation);
    case PacketKind::relayed:
      if (packet.relayed->has_data) return run(server::RelayedData{}, relation);
      if (!packet.relayed->numbers.empty()) return run(server::Gap{}, relation);
      return run(server::RelayHeartbeat{}, relation);
    default:
      return false;
  }
}

template <class Host>
template <class World>
bool ServerSteps<Host>::answer(server::LacksSomething, const World& w) const {
  const RelayWriter& writer = relay_at(w);
  const RelayWriter::Reader& reader = writer.about.at(w.template number<comp::owner::relation>());
  const std::int64_t wanted = writer.empty() ? writer.last() : writer.first();
  return reader.low < wanted || std::ranges::any_of(reader.list, [](const auto& one) {
           return is_in<fsm::change_for_reader::U>(one.second);
         });
}

template <class Host>
template <class World>
void ServerSteps<Host>::perform(server::ListRelevant, World& w) {
  const auto relation = w.template number<comp::owner::relation>();
  for (const auto& [number, item] : relay_at(w).history) {
    if (!server_at(w).database.relevant(item, client_of(relation))) continue;
    step<fsm::change_for_reader::ReaderMatched>(about(relation).list[number], relation);
  }
}

/// What is relevant is unacknowledged again, if it is not in the list anyway.
template <class Host>
template <class World>
void ServerSteps<Host>::perform(server::ListAgain, World& w) {
  const auto relation = w.template number<comp::owner::relation>();
  const RelayWriter& writer = relay_at(w);
  RelayWriter::Reader& reader = about(relation);
  reader.low = std::min(reader.low, writer.first() - 1);
  for (const auto& [number, item] : writer.history) {
    if (reader.list.contains(number)) continue;
    if (!server_at(w).database.relevant(item, client_of(relation))) continue;
    step<fsm::change_for_reader::ReaderMatched>(reader.list[number], relation);
  }
}

template <class Host>
template <class World>
void ServerSteps<Host>::perform(server::TakeAckNack, World& w) {
  namespace change = fsm::change_for_reader;
  const auto relation = w.template number<comp::owner::relation>();
  const Relayed& acknack = *w.packet().relayed;
  RelayWriter::Reader& reader = about(relation);
  reader.low = std::max(reader.low, acknack.base - 1);
  const auto above = reader.list.lower_bound(acknack.base);
  for (auto entry = reader.list.begin(); entry != above; ++entry) {
    step<change::AckNackReceived>(entry->second, relation, false, true);
  }
  reader.list.erase(reader.list.begin(), above);
  const std::int64_t first = relay_at(w).first();
  some_requested_ = false;
  some_irrelevant_ = false;
  irrelevant_.clear();
  for (const std::int64_t number : acknack.numbers) {
    const auto entry = reader.list.find(number);
    if (entry != reader.list.end()) {
      some_requested_ |= step<change::AckNackReceived>(entry->second, relation, true).requested;
    } else if (number >= first) {
      irrelevant_.push_back(number);
      some_irrelevant_ |= number > reader.low;
    }
  }
}

template <class Host>
template <class World>
void ServerSteps<Host>::perform(server::QueueAgain, World& w) {
  const Number relay = w.template number<comp::owner::writer>() % relay::count;
  Server& one = server_at(w);
  for (const Number relation : one.relays[relay].readers) {
    for (auto& [number, entry] : about(relation).list) {
      if (!step<fsm::change_for_reader::NackResponseDue>(entry, relation).enqueue) continue;
      one.queues.add_again({relay, one.relays[relay].history.at(number)});
    }
  }
}

template <class Host>
void ServerSteps<Host>::note_acknowledgements(Server& one) {
  const Item own = one.database.announcement(one.id);
  for (const Number relay : {relay::subscriptions, relay::publications, relay::announcements}) {
    const std::map<std::int64_t, Item> history = one.relays[relay].history;
    for (const auto& [number, item] : history) {
      if (item == own && one.database.all_noted) continue;
      if (is_pending(one, relay, number, item)) continue;
      if (item == own)
        one.database.all_noted = true;
      else
        leave_history(one, relay, item);
    }
  }
}

/// Notes who has acknowledged it; somebody for whom it is relevant may be left.
template <class Host>
bool ServerSteps<Host>::is_pending(Server& one, Number relay, std::int64_t number, Item item) {
  bool pending = false;
  for (const Number relation : one.relays[relay].readers) {
    const Number client = client_of(relation);
    if (!one.database.relevant(item, client)) continue;
    const RelayWriter::Reader& reader = about(relation);
    if (number <= reader.low || !reader.list.contains(number))
      one.database.note(item, client);
    else
      pending = true;
  }
  return pending;
}

template <class Host>
void ServerSteps<Host>::insert_all(Server& one, const Database::Lists& lists) {
  for (const Item item : lists.announcements) insert(one, relay::announcements, item);
  for (const Item item : lists.publications) insert(one, relay::publications, item);
  for (const Item item : lists.subscriptions) insert(one, relay::subscriptions, item);
}

template <class Host>
template <class World>
void ServerSteps<Host>::perform(server::UpdateWithGoodbyes, World& w) {
  Server& one = server_at(w);
  note_acknowledgements(one);
  const Database::Lists lists = one.database.update();
  for (const Item item : lists.leaving) remove(one, relay_of(one, item), item);
  for (const Item item : lists.goodbyes) {
    const bool wanted = insert(one, relay::announcements, item);
    if (wanted || one.relays[relay::announcements].readers.empty()) continue;
    run_for_relay<server::Needless>(one, relay::announcements);
  }
  insert_all(one, lists);
}

/// The item gets a new number, also if it is in the history already. Whether it is relevant for
/// somebody, as all is that the database lists but for goodbyes.
template <class Host>
bool ServerSteps<Host>::insert(Server& one, Number relay, Item item) {
  remove(one, relay, item);
  RelayWriter& writer = one.relays[relay];
  const std::int64_t number = writer.append(item);
  bool wanted = false;
  for (const Number relation : writer.readers) {
    if (!one.database.relevant(item, client_of(relation))) continue;
    step<fsm::change_for_reader::Created>(about(relation).list[number], relation);
    wanted = true;
  }
  if (!wanted) return false;
  one.queues.add({relay, item});
  run_for_relay<server::Inserted>(one, relay);
  return true;
}

/// Returns the number of packets; changes that nobody wants any more take none.
template <class Host>
std::int64_t ServerSteps<Host>::deliver(Server& one, SendingQueues::Entry entry) {
  RelayWriter& writer = one.relays[entry.relay];
  const std::int64_t number = writer.number_of(entry.item);
  std::vector<Number> wanting;
  for (const Number relation : writer.readers) {
    const auto& list = about(relation).list;
    const auto found = list.find(number);
    if (found != list.end() && is_in<fsm::change_for_reader::Q>(found->second))
      wanting.push_back(relation);
  }
  if (wanting.empty()) return 0;
  served_ = entry;
  auto packets = static_cast<std::int64_t>(wanting.size());
  for (const Number relation : wanting) packets += skip_before(relation, number) ? 1 : 0;
  for (const Number relation : wanting) {
    step<fsm::change_for_reader::Serialized>(about(relation).list.at(number), relation);
    host().template run<fsm::composition::Happens<server::Served>>(relation);
  }
  run_for_relay<server::Delivered>(one, entry.relay);
  return packets;
}

/// The first time that a change is sent to a reader, it is told what it does not need before it.
template <class Host>
bool ServerSteps<Host>::skip_before(Number relation, std::int64_t number) {
  RelayWriter::Reader& reader = about(relation);
  const auto entry = reader.list.find(number);
  if (std::exchange(entry->second.sent, true)) return false;
  const std::int64_t before = entry == reader.list.begin() ? reader.low : std::prev(entry)->first;
  irrelevant_.clear();
  const std::int64_t first = writer(writer_of(relation)).first();
  for (std::int64_t k = std::max(before + 1, first); k < number; ++k) irrelevant_.push_back(k);
  if (irrelevant_.empty()) return false;
  host().template run<fsm::composition::Happens<server::Skipped>>(relation);
  return true;
}

template <class Host>
Relayed ServerSteps<Host>::data_of(const Server& one, SendingQueues::Entry entry) const {
  const Database::Contents& contents = one.database.contents(entry.item);
  Relayed data;
  data.has_data = true;
  data.is_announcement = contents.is_announcement;
  data.is_goodbye = contents.is_announcement && one.database.is_gone(contents.participant);
  data.participant = contents.participant;
  data.stream = contents.stream;
  data.descriptor = contents.descriptor;
  data.number = one.relays[entry.relay].number_of(entry.item);
  return data;
}

template <class Host>
template <class World>
void ServerSteps<Host>::perform(server::TakeRelayed, World& w) {
  const auto relation = w.template number<comp::owner::relation>();
  const Relayed& relayed = *w.packet().relayed;
  Learner& reader = learner(relation);
  if (relayed.has_data) {
    reader.receive(relayed.number);
    reader.announced = std::max(reader.announced, relayed.number);
    learn(relation, relayed);
    if (steps_of_.ends_now()) return;
  }
  for (const std::int64_t number : relayed.numbers) reader.receive(number);
  if (!relayed.has_heartbeat) return;
  reader.base = std::max(reader.base, relayed.first);
  reader.announced = std::max(reader.announced, relayed.last);
}

template <class Host>
void ServerSteps<Host>::learn(Number relation, const Relayed& relayed) {
  const Pair& ends = ends_of(relation / relay::count);
  if (steps_of_.topology.is_server(ends.destination)) {
    learn_from_server(ends, relayed);
  } else {
    host().learn(ends.destination, relayed);
  }
}

/// A server takes what another one tells it as what its clients tell it. Of those whom it hears
/// itself it believes itself alone whether they are gone.
template <class Host>
void ServerSteps<Host>::learn_from_server(const Pair& ends, const Relayed& relayed) {
  const Topology& topology = steps_of_.topology;
  const Number i = relayed.participant;
  if (topology.is_server(i)) return;
  Database& database = server_of(ends.destination).database;
  if (relayed.is_goodbye) {
    if (database.is_direct(i)) return;
    database.leave(i);
  } else if (relayed.is_announcement) {
    database.hear_of(i, ends.source);
  } else {
    const Item item = database.descriptor(i, relayed.stream, relayed.descriptor);
    database.has(ends.source, item);
    if (!database.arrive(item)) return;
  }
  host().template run<fsm::composition::Happens<server::Arrives>>(ends.destination);
}

/// What is below the base, or has been received, is old news, and so is a HEARTBEAT whose number is
/// not above that of the last one.
template <class Host>
template <class World>
void ServerSteps<Host>::perform(server::TakeNew, World& w) {
  const auto relation = w.template number<comp::owner::relation>();
  const Relayed& relayed = *w.packet().relayed;
  Learner& reader = learner(relation);
  const auto is_old = [&](std::int64_t number) {
    return number < reader.base || reader.has(number);
  };
  if (relayed.has_data && !is_old(relayed.number)) {
    reader.receive(relayed.number);
    reader.announced = std::max(reader.announced, relayed.number);
    learn(relation, relayed);
    if (steps_of_.ends_now()) return;
  }
  for (const std::int64_t number : relayed.numbers) reader.receive(number);
  heartbeat_is_new_ = relayed.has_heartbeat && relayed.count > reader.heartbeats;
  if (!heartbeat_is_new_) return;
  reader.heartbeats = relayed.count;
  reader.base = std::max(reader.base, relayed.first);
  reader.announced = std::max(reader.announced, relayed.last);
}

template <class Host>
template <class World>
void ServerSteps<Host>::perform(server::LoseDatabase, World& w) {
  const auto id = w.template number<comp::owner::participant>();
  const Topology& topology = steps_of_.topology;
  for (Number pair = topology.first_pair(id); pair < topology.first_pair(id + 1); ++pair) {
    RunningWorld<Host, comp::owner::pair> client{host(), topology.pair(pair).reverse};
    if (topology.is_server(topology.pair(pair).destination)) {
      client.call(server::CloseServer{});
    } else {
      client.call(server::CloseClient{});
    }
  }
  for (Number relay = 0; relay < relay::count; ++relay) {
    RunningWorld<Host, comp::owner::writer> of_relay{host(), relay::count * id + relay};
    server::lose_relay(of_relay);
  }
  server_of(id) = begin(id - topology.first_server());
}

template <class Host>
Relayed ServerSteps<Host>::asks(Number relation, bool initial) {
  Relayed acknack;
  if (initial) return acknack;
  Learner& reader = learner(relation);
  while (reader.has(reader.base)) ++reader.base;
  acknack.base = reader.base;
  for (std::int64_t number = reader.base; number <= reader.announced; ++number) {
    if (!reader.has(number)) acknack.numbers.push_back(number);
  }
  return acknack;
}

}  // namespace stormproof::model::fastdds
