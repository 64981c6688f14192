// A host of the rules of a Discovery Server (fsm/composition/server.hpp,
// specs/guide/discovery-server.md). What its steps do is in server_steps.hpp; descriptors on their
// way to the server, and control-only relations, are those of `Base`, a host of Fast DDS's rules,
// with a life or without. `Self` is the host itself. What goes out between the server and its
// clients is in server_packets.hpp.
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "model/engine/packet_tags.hpp"
#include "model/fastdds/matching.hpp"
#include "model/fastdds/protocol.hpp"
#include "model/fastdds/relayed.hpp"
#include "model/fastdds/server_relays.hpp"
#include "model/servers.hpp"

namespace stormproof::model::fastdds {

struct ServerColumns : ServerNumbers {
  using PlainColumns::column;
  static way::Elsewhere column(server::Change);  // in lists
  static way::Tokens column(server::RoutineAgain);
  static way::Capped column(server::RegistrationLastDelay);
  static way::Capped column(server::LearnerLastDelay);
};
/// A packet between the server and a client.
template <class P>
concept OfServer = model::detail::is_listed<P>(server::FastDdsServer::Packets{});

template <class Self, class Base, class Composition_, class Columns>
class ServerHost : public Stored<Self, Base, ThingsBeside<Composition_, Base>, Columns,
                                 fsm::TypeList<server::RelayOpen>>,
                   public ServerSteps<Self> {
  using Below = Stored<Self, Base, ThingsBeside<Composition_, Base>, Columns,
                       fsm::TypeList<server::RelayOpen>>;
  using Steps = ServerSteps<Self>;
  using Number = std::uint32_t;

 public:
  using Composition = Composition_;

  ServerHost(RunState& run, Network& network) : Below{run, network}, Steps{run} {}

  void start() override {
    Base::start();
    Steps::for_those_who_seek(
        [&](Number pair, std::int64_t at) { this->schedule(server::ClientSync{}, pair, at); });
  }
  void handle(const Event& event) override {
    if (!run_due(this->self(), event)) Base::handle(event);
  }
  void received(const Packet& packet, Number receiver) override {
    if (this->run_.now < this->topology().start(receiver)) return;
    if (!Steps::take_in(packet)) Base::received(packet, receiver);
  }
  [[nodiscard]] std::optional<Number> sender_of(const Event& event) const override {
    const std::optional<Number> actor = actor_of_timer(static_cast<const Self&>(*this), event);
    return actor ? actor : Base::sender_of(event);
  }
  void count(const Packet& packet) override;
  [[nodiscard]] std::vector<MissingDescriptor> missing(std::size_t limit) override;

  // The host of a RunningWorld.
  using Base::answer;
  using Base::perform;
  using Steps::answer;
  using Steps::changed;
  using Steps::perform;
  using Steps::readers;

  // What steps ask of it.
  template <class Trigger>
  void run(Number n, const Packet* packet = nullptr) {
    run_rule<Trigger>(this->self(), n, packet);
  }
  template <class Occasion>
  void runs_for_clients(Number relation) {
    run_rule<comp::Happens<Occasion>>(static_cast<Base&>(*this), relation);
  }
  using Base::open_builtin;
  void learn(Number client, const Relayed& relayed);
  void take_descriptors(Number relation, const DescriptorSet& received) override;

  // Packets.
  using Base::emit;
  template <OfServer P, class World, class... Sayings>
  void emit(P packet, World& w, const std::tuple<Sayings...>&) {
    constexpr bool says = sizeof...(Sayings) > 0;
    if constexpr (P::owner == comp::owner::pair) {
      send_registration(packet_kind_of<P>, w.template number<P::owner>(), says);
    } else if constexpr (std::is_same_v<P, server::RelayedAckNack>) {
      send_acknack(w.template number<P::owner>(), says);
    } else {
      const auto relation = w.template number<P::owner>();
      send_relayed(relation, this->contents(packet, relation, says));
    }
  }

 protected:
  /// Whether discovery needs that the pair's destination learns the descriptor: it has the other
  /// side of its topic.
  [[nodiscard]] virtual bool is_required(const Pair& pair, Stream s, Number d) const {
    if (this->topology().is_server(pair.source) || this->topology().is_server(pair.destination))
      return false;
    return has_other_side(this->topology(), pair.destination, s, d);
  }
  /// Clients are told one descriptor after the other, in no order.
  [[nodiscard]] bool is_notified(Number pair, Stream s, Number d) const override {
    const auto relation = static_cast<Number>(2 * pair + index_of(s));
    return (this->changes().received(relation, d / 64) >> d % 64 & 1) != 0;
  }

 private:
  void begin_announcing(Number i) override {
    const Number first = servers_of(this->run_.scenario.deployment, i).front();
    this->schedule(server::ClientAnnouncement{}, this->topology().pair_between(i, first),
                   this->topology().start(i).count());
  }

  // server_packets.hpp
  void send_registration(PacketKind kind, Number pair, bool initial);
  void send_acknack(Number relation, bool initial);
  void send_relayed(Number relation, Relayed relayed);
};

template <class Self, class Base, class Composition_, class Columns>
void ServerHost<Self, Base, Composition_, Columns>::count(const Packet& packet) {
  Counts& counts = this->run_.counts;
  const bool of_announcements = packet.detail == relay::announcements;
  switch (packet.kind) {
    case PacketKind::registration:
      ++counts.pdp_data;
      break;
    case PacketKind::registration_heartbeat:
      ++counts.pdp_heartbeat;
      break;
    case PacketKind::registration_acknack:
      ++counts.pdp_acknack;
      break;
    case PacketKind::relayed_acknack:
      ++(of_announcements ? counts.pdp_acknack : counts.acknack);
      break;
    case PacketKind::relayed:
      if (packet.relayed->has_heartbeat) {
        ++(of_announcements ? counts.pdp_heartbeat : counts.heartbeat);
      }
      if (!packet.relayed->numbers.empty()) {
        ++counts.gap;
      } else if (packet.relayed->has_data && packet.relayed->is_announcement) {
        ++counts.pdp_data;
      } else if (packet.relayed->has_data) {
        ++(packet.carries_initial ? counts.initial_data : counts.repair_data);
      }
      break;
    default:
      Base::count(packet);
  }
}

template <class Self, class Base, class Composition_, class Columns>
std::vector<MissingDescriptor> ServerHost<Self, Base, Composition_, Columns>::missing(
    std::size_t limit) {
  std::vector<MissingDescriptor> list;
  for (Number pair = 0; pair < this->topology().pair_count(); ++pair) {
    const Pair& p = this->topology().pair(pair);
    for (const Stream s : streams) {
      for (Number d = 0; d < this->topology().descriptor_count(p.source, s); ++d) {
        if (!is_required(p, s, d) || is_notified(pair, s, d)) continue;
        if (list.size() == limit) return list;
        list.push_back({ParticipantId{p.source}, ParticipantId{p.destination}, s, DescriptorId{d}});
      }
    }
  }
  return list;
}

/// A reader of the server has received a client's descriptors.
template <class Self, class Base, class Composition_, class Columns>
void ServerHost<Self, Base, Composition_, Columns>::take_descriptors(
    Number relation, const DescriptorSet& received) {
  const Number server = this->ends(relation).destination;
  const DescriptorSet missing = this->changes().missing(relation);
  this->changes().receive(relation, received);
  bool some = false;
  missing.for_each([&](std::uint32_t d) {
    if ((this->changes().received(relation, d / 64) >> d % 64 & 1) == 0) return;
    --this->template at<Lacking>(relation);
    this->arrive(server, this->ends(relation).source, this->stream_of(relation), d);
    some = true;
  });
  if (some) run<comp::Happens<server::Arrives>>(server);
}

template <class Self, class Base, class Composition_, class Columns>
void ServerHost<Self, Base, Composition_, Columns>::learn(Number client, const Relayed& relayed) {
  if (relayed.participant == client) return;  // only a mistake tells it of itself
  const Number pair = this->topology().pair_between(relayed.participant, client);
  const Pair& p = this->topology().pair(pair);
  if (relayed.is_announcement) {
    if (this->value(comp::Recognised{}, pair)) return;
    this->assign(comp::Recognised{}, pair, true);
    open_builtin(pair);
    return;
  }
  const Number d = relayed.descriptor;
  const bool required = is_required(p, relayed.stream, d);
  if (is_notified(pair, relayed.stream, d)) {
    if (required) ++this->run_.duplicate_deliveries;
    return;
  }
  const auto relation = static_cast<Number>(2 * pair + index_of(relayed.stream));
  DescriptorSet one;
  one.add(d / 64, std::uint64_t{1} << d % 64);
  this->changes().receive(relation, one);
  if (required) {
    ++this->run_.useful_deliveries;
    if (--this->run_.missing == 0) {
      this->run_.last_delivered = {ParticipantId{p.source}, ParticipantId{p.destination},
                                   relayed.stream, DescriptorId{d}};
    }
    if (this->run_.ends_now()) return;
  }
  if (p.cross_host) this->open_notified(pair, relayed.stream, d);
}

}  // namespace stormproof::model::fastdds
