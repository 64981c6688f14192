// Fast DDS with a Discovery Server, as a host of its rules (fsm/composition/server.hpp,
// specs/guide/discovery-server.md). What its steps do is in server_steps.hpp. Descriptors on their
// way to the server, and control-only relations, are those of `Protocol`. By source file:
//   server_protocol.cpp  events and packets to rules, what a client learns
//   server_packets.cpp   what goes out between the server and its clients
#pragma once

#include <cstdint>
#include <utility>
#include <vector>

#include "fsm/composition/server.hpp"
#include "model/engine/packet_tags.hpp"
#include "model/fastdds/protocol.hpp"
#include "model/fastdds/relayed.hpp"
#include "model/fastdds/server_relays.hpp"

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
using ServerThings = ThingsBeside<server::FastDdsServer, Protocol>;

class ServerProtocol final : public Stored<ServerProtocol, Protocol, ServerThings, ServerColumns,
                                           fsm::TypeList<server::RelayOpen>>,
                             public ServerSteps<ServerProtocol> {
  using Number = std::uint32_t;

 public:
  using Composition = server::FastDdsServer;

  ServerProtocol(RunState& run, Network& network);

  void handle(const Event& event) override;
  void received(const Packet& packet, Number receiver) override;
  [[nodiscard]] std::optional<Number> sender_of(const Event& event) const override;
  void count(const Packet& packet) override;
  [[nodiscard]] std::vector<MissingDescriptor> missing(std::size_t limit) override;

  // The host of a RunningWorld.
  using Protocol::answer;
  using Protocol::perform;
  using ServerSteps::answer;
  using ServerSteps::changed;
  using ServerSteps::perform;
  using ServerSteps::readers;

  // What steps ask of it.
  template <class Trigger>
  void run(Number n, const Packet* packet = nullptr) {
    run_rule<Trigger>(*this, n, packet);
  }
  template <class Occasion>
  void runs_for_clients(Number relation) {
    run_rule<comp::Happens<Occasion>>(static_cast<Protocol&>(*this), relation);
  }
  using Protocol::open_builtin;
  void learn(Number client, const Relayed& relayed);

  // Packets.
  using Protocol::emit;
  template <OfServer P, class World, class... Sayings>
  void emit(P packet, World& w, const std::tuple<Sayings...>&) {
    constexpr bool says = sizeof...(Sayings) > 0;
    if constexpr (P::owner == comp::owner::pair) {
      send_registration(packet_kind_of<P>, w.template number<P::owner>(), says);
    } else if constexpr (std::is_same_v<P, server::RelayedAckNack>) {
      send_acknack(w.template number<P::owner>(), says);
    } else {
      const auto relation = w.template number<P::owner>();
      send_relayed(relation, contents(packet, relation, says));
    }
  }

 private:
  // server_protocol.cpp
  void begin_announcing(Number i) override;
  void take_descriptors(Number relation, const DescriptorSet& received) override;
  [[nodiscard]] bool is_notified(Number pair, Stream s, Number d) const override;
  [[nodiscard]] bool is_required(const Pair& pair, Stream s, Number d) const;

  // server_packets.cpp
  void send_registration(PacketKind kind, Number pair, bool initial);
  void send_acknack(Number relation, bool initial);
  [[nodiscard]] bool is_first_for(Number client, const Relayed& data);
  void send_relayed(Number relation, Relayed relayed);
};

}  // namespace stormproof::model::fastdds
