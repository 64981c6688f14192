// What starts rules of a Discovery Server and its clients, how observers hear of both, and what a
// client learns and asks for.
#include "props/monitors/followed_server.hpp"

#include <algorithm>
#include <memory>
#include <utility>

namespace stormproof::props {

ServerFollower::ServerFollower(const model::Scenario& scenario, const model::Topology& topology)
    : FollowedFastDds{scenario, topology}, database_{topology, scenario.dds} {
  FollowedRelay& announcements = relays_[relay::announcements];
  announcements.history.emplace(announcements.next++, database_.own_announcement());
}

/// Announcement 0 of every client; endpoints are created when the deployment says.
void ServerFollower::started() {
  begin("The start");
  for (std::uint32_t i = 0; i < server_id(); ++i) {
    const std::uint32_t pair = topology_.pair_between(i, server_id());
    expect_timer(server::ClientAnnouncement{}, pair, topology_.start(i), {});
    take_creations(i);
  }
}

void ServerFollower::received(const Message& message, std::uint32_t receiver,
                              model::Nanoseconds emitted) {
  if (!has_started(receiver)) return;
  const auto take = [&]<class Packet>(Packet, const Place& place) {
    run<comp::Received<Packet>>(place, &message);
  };
  switch (message.kind) {
    case model::PacketKind::registration:
      return take(server::Registration{}, relation_place(2 * message.pair));
    case model::PacketKind::registration_heartbeat:
      return take(server::RegistrationHeartbeat{}, relation_place(2 * message.pair));
    case model::PacketKind::registration_acknack:
      return take(server::RegistrationAckNack{}, relation_place(2 * message.pair));
    case model::PacketKind::relayed:
    case model::PacketKind::relayed_acknack:
      break;
    default:
      return FollowedFastDds::received(message, receiver, emitted);
  }
  const Place relation = relation_place(relay_relation(message.pair, message.detail));
  if (message.kind == model::PacketKind::relayed_acknack)
    take(server::RelayedAckNack{}, relation);
  else if (message.relayed.of->has_data)
    take(server::RelayedData{}, relation);
  else if (!message.relayed.of->numbers.empty())
    take(server::Gap{}, relation);
  else
    take(server::RelayHeartbeat{}, relation);
}

Place ServerFollower::relation_place(std::uint32_t relation) const {
  if (relation < topology_.relation_count()) return FollowedFastDds::relation_place(relation);
  const std::uint32_t n = relation - topology_.relation_count();
  return {.participant = topology_.pair(n / relay::count).source,
          .pair = n / relay::count,
          .writer = relay_writer(n % relay::count),
          .relation = relation};
}

Place ServerFollower::writer_place(std::uint32_t writer) const {
  if (writer < relay_writer(0)) return FollowedFastDds::writer_place(writer);
  return {.participant = server_id(), .writer = writer};
}

std::uint32_t ServerFollower::owner_of(const model::Event& event) const {
  std::uint32_t owner = event.subject;
  comp::for_each_type(server::FastDdsServer::Timers{}, [&]<class T>() {
    if (event.kind != model::event_kind_of<T>) return;
    if (T::owner == comp::owner::relation) owner = relay_relation(event.subject, event.detail);
    if (T::owner == comp::owner::writer) owner = relay_writer(event.detail);
  });
  return owner;
}

/// A reader of the server receives what is new to it.
void ServerFollower::becomes(comp::X, const Place& place) {
  const std::uint32_t stream = place.relation % 2;
  database_.arrive({place.participant, relay::publications + stream, place.descriptor});
  some_arrived_ = true;
}

void ServerFollower::all_are_set(comp::X, const Place& place) {
  if (!std::exchange(some_arrived_, false)) return;
  World w = world_at({.participant = topology_.pair(place.pair).destination});
  w.raise(server::Arrives{});
}

void ServerFollower::perform(server::OpenReaders, const World& w) {
  for (const std::uint32_t relation : FollowedFastDds::streams_of(w.place().pair)) {
    World r = world_at(relation_place(relation));
    r.raise(comp::ReaderOpens{});
  }
}

void ServerFollower::perform(server::OpenOwnWriter, const World& w) {
  const std::uint32_t pair = topology_.pair(w.place().pair).reverse;
  World own = world_at(relation_place(2 * pair + relay_of(w) - relay::publications));
  own.raise(fastdds::WriterOpens{});
}

void ServerFollower::perform(server::TakeRelayed, const World& w) {
  const model::Relayed& relayed = *w.heard().relayed.of;
  FollowedLearner& reader = learners_[w.place().relation];
  if (relayed.has_data) {
    reader.received.insert(relayed.number);
    reader.announced = std::max(reader.announced, relayed.number);
    learn(w, relayed);
    if (ends_now(w)) return;
  }
  reader.received.insert(relayed.numbers.begin(), relayed.numbers.end());
  if (!relayed.has_heartbeat) return;
  reader.base = std::max(reader.base, relayed.first);
  reader.announced = std::max(reader.announced, relayed.last);
}

/// The first time. Discovery needs what is on a topic of which the client has the other side.
void ServerFollower::learn(const World& w, const model::Relayed& relayed) {
  const std::uint32_t client = topology_.pair(w.place().pair).destination;
  const std::uint32_t pair = topology_.pair_between(relayed.participant, client);
  const std::uint32_t stream = relayed.stream == model::Stream::sub ? 1 : 0;
  Place place = relation_place(2 * pair + stream);
  if (relayed.is_announcement) {
    if (value<comp::Recognised>(place) != 0) return;
    assign<comp::Recognised>(place, 1);
  } else {
    place.descriptor = relayed.descriptor;
    if (value<fastdds::Notified>(place) != 0) return;
    assign<fastdds::Notified>(place, 1);
    const RelayedItem item{relayed.participant, relay::publications + stream, relayed.descriptor};
    if (database_.opposite(item, client)) --missing_;
    if (ends_now(w)) return;
  }
  if (topology_.pair(pair).cross_host) open_sides(pair);
}

Message ServerFollower::message_at(const World& w, model::PacketKind kind) const {
  Message message;
  message.kind = kind;
  message.pair = w.place().pair;
  message.detail = relay_of(w);
  const bool of_subscriptions = message.detail == relay::subscriptions;
  message.stream = of_subscriptions ? model::Stream::sub : model::Stream::pub;
  return message;
}

/// It asks for what is missing of what is announced; an initial one claims nothing.
void ServerFollower::expect_acknack(const World& w, bool initial, comp::Site site) {
  model::Relayed asks;
  if (!initial) {
    FollowedLearner& reader = learners_[w.place().relation];
    while (reader.received.contains(reader.base)) ++reader.base;
    asks.base = reader.base;
    for (std::int64_t number = reader.base; number <= reader.announced; ++number) {
      if (!reader.received.contains(number)) asks.numbers.push_back(number);
    }
  }
  Message message = message_at(w, model::PacketKind::relayed_acknack);
  message.initial = initial;
  message.relayed.of = std::make_shared<const model::Relayed>(std::move(asks));
  expect(message, site);
}

void ServerFollower::expect_relayed(const World& w, model::Relayed relayed, comp::Site site) {
  Message message = message_at(w, model::PacketKind::relayed);
  message.carries_heartbeat = relayed.has_heartbeat;
  message.relayed.of = std::make_shared<const model::Relayed>(std::move(relayed));
  expect(message, site);
}

std::unique_ptr<Follower> follow(model::Of<server::FastDdsServer>, const model::Scenario& scenario,
                                 const model::Topology& topology) {
  return std::make_unique<ServerFollower>(scenario, topology);
}

}  // namespace stormproof::props
