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
  const RelayWriter& writer = relays_[relay_at(w)];
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
  for (const auto& [number, item] : relays_[relay_at(w)].history) {
    if (!database_.relevant(item, client_of(relation / relay::count))) continue;
    step<fsm::change_for_reader::ReaderMatched>(about(relation).list[number], relation);
  }
}

/// What is relevant is unacknowledged again, if it is not in the list anyway.
template <class Host>
template <class World>
void ServerSteps<Host>::perform(server::ListAgain, World& w) {
  const auto relation = w.template number<comp::owner::relation>();
  const RelayWriter& writer = relays_[relay_at(w)];
  RelayWriter::Reader& reader = about(relation);
  reader.low = std::min(reader.low, writer.first() - 1);
  for (const auto& [number, item] : writer.history) {
    if (reader.list.contains(number)) continue;
    if (!database_.relevant(item, client_of(relation / relay::count))) continue;
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
  const std::int64_t first = relays_[relay_at(w)].first();
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
  const Number relay = relay_at(w);
  for (const Number relation : relays_[relay].readers) {
    for (auto& [number, entry] : about(relation).list) {
      if (!step<fsm::change_for_reader::NackResponseDue>(entry, relation).enqueue) continue;
      queues_.add_again({relay, relays_[relay].history.at(number)});
    }
  }
}

template <class Host>
void ServerSteps<Host>::note_acknowledgements() {
  const Item own = database_.announcement(server_id());
  for (const Number relay : {relay::subscriptions, relay::publications, relay::announcements}) {
    const std::map<std::int64_t, Item> history = relays_[relay].history;
    for (const auto& [number, item] : history) {
      if (item == own && database_.all_noted) continue;
      if (is_pending(relay, number, item)) continue;
      if (item == own)
        database_.all_noted = true;
      else
        leave_history(relay, item);
    }
  }
}

/// Notes who has acknowledged it; somebody for whom it is relevant may be left.
template <class Host>
bool ServerSteps<Host>::is_pending(Number relay, std::int64_t number, Item item) {
  bool pending = false;
  for (const Number relation : relays_[relay].readers) {
    const Number client = client_of(relation / relay::count);
    if (!database_.relevant(item, client)) continue;
    const RelayWriter::Reader& reader = about(relation);
    if (number <= reader.low || !reader.list.contains(number))
      database_.note(item, client);
    else
      pending = true;
  }
  return pending;
}

template <class Host>
void ServerSteps<Host>::insert_all(const Database::Lists& lists) {
  for (const Item item : lists.announcements) insert(relay::announcements, item);
  for (const Item item : lists.publications) insert(relay::publications, item);
  for (const Item item : lists.subscriptions) insert(relay::subscriptions, item);
}

template <class Host>
template <class World>
void ServerSteps<Host>::perform(server::UpdateWithGoodbyes, World&) {
  note_acknowledgements();
  const Database::Lists lists = database_.update();
  for (const Item item : lists.leaving) remove(relay_of(item), item);
  for (const Item item : lists.goodbyes) {
    const bool wanted = insert(relay::announcements, item);
    if (wanted || relays_[relay::announcements].readers.empty()) continue;
    run_for_relay<server::Needless>(relay::announcements);
  }
  insert_all(lists);
}

/// The item gets a new number, also if it is in the history already. Whether it is relevant for
/// somebody, as all is that the database lists but for goodbyes.
template <class Host>
bool ServerSteps<Host>::insert(Number relay, Item item) {
  remove(relay, item);
  RelayWriter& writer = relays_[relay];
  const std::int64_t number = writer.append(item);
  bool wanted = false;
  for (const Number relation : writer.readers) {
    if (!database_.relevant(item, client_of(relation / relay::count))) continue;
    step<fsm::change_for_reader::Created>(about(relation).list[number], relation);
    wanted = true;
  }
  if (!wanted) return false;
  queues_.add({relay, item});
  run_for_relay<server::Inserted>(relay);
  return true;
}

/// Returns the number of packets; changes that nobody wants any more take none.
template <class Host>
std::int64_t ServerSteps<Host>::deliver(SendingQueues::Entry entry) {
  RelayWriter& writer = relays_[entry.relay];
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
  run_for_relay<server::Delivered>(entry.relay);
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
  const std::int64_t first = relays_[relation % relay::count].first();
  for (std::int64_t k = std::max(before + 1, first); k < number; ++k) irrelevant_.push_back(k);
  if (irrelevant_.empty()) return false;
  host().template run<fsm::composition::Happens<server::Skipped>>(relation);
  return true;
}

template <class Host>
Relayed ServerSteps<Host>::data_of(SendingQueues::Entry entry) const {
  const Database::Contents& contents = database_.contents(entry.item);
  Relayed data;
  data.has_data = true;
  data.is_announcement = contents.is_announcement;
  data.is_goodbye = contents.is_announcement && database_.is_gone(contents.participant);
  data.participant = contents.participant;
  data.stream = contents.stream;
  data.descriptor = contents.descriptor;
  data.number = relays_[entry.relay].number_of(entry.item);
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
    host().learn(client_of(relation / relay::count), relayed);
    if (steps_of_.ends_now()) return;
  }
  for (const std::int64_t number : relayed.numbers) reader.receive(number);
  if (!relayed.has_heartbeat) return;
  reader.base = std::max(reader.base, relayed.first);
  reader.announced = std::max(reader.announced, relayed.last);
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
    host().learn(client_of(relation / relay::count), relayed);
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
void ServerSteps<Host>::perform(server::LoseDatabase, World&) {
  for (Number client = 0; client < server_id(); ++client) {
    RunningWorld<Host, comp::owner::pair>{host(),
                                          steps_of_.topology.pair_between(client, server_id())}
        .call(server::CloseClient{});
  }
  for (Number relay = 0; relay < relay::count; ++relay) {
    RunningWorld<Host, comp::owner::writer> w{host(), relay::count * server_id() + relay};
    server::lose_relay(w);
  }
  database_ = {steps_of_.topology, dds().discovery, dds().server};
  relays_ = {};
  queues_ = {};
  acknacks_ = {};
  begin();
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
