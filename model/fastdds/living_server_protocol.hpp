// Fast DDS with a Discovery Server whose clients have a life, as a host of its rules
// (fsm/composition/server_life.hpp, specs/guide/discovery-server.md, "Lives with a server").
#pragma once

#include <cstdint>
#include <utility>

#include "fsm/composition/server_life.hpp"
#include "model/fastdds/living_protocol.hpp"
#include "model/fastdds/server_host.hpp"

namespace stormproof::model::fastdds {

class LivingServerProtocol final
    : public ServerHost<LivingServerProtocol, LivingProtocol, server::FastDdsServerLiving,
                        LivingColumns<ServerColumns>> {
  using Number = std::uint32_t;

 public:
  LivingServerProtocol(RunState& run, Network& network);

  void start() override;
  void handle(const Event& event) override;
  void received(const Packet& packet, Number receiver) override;

  // The host of a RunningWorld.
  using LivingProtocol::renew;
  using ServerSteps::renew;
  template <class P>
  requires(model::detail::is_listed<P>(server::FastDdsServer::Parts{}) &&
           !std::is_same_v<P, comp::AnnouncementTimer> &&
           !std::is_same_v<P, server::Change>) void renew(P part, Number n);

  // What steps ask of it.
  void forget_exchange(Number pair);
  void learn(Number client, const Relayed& relayed);
  void take_descriptors(Number relation, const DescriptorSet& received) override;

 private:
  [[nodiscard]] bool is_required(const Pair& pair, Stream s, Number d) const override {
    return waits_for(pair.source) && waits_for(pair.destination) &&
           ServerHost::is_required(pair, s, d);
  }
  void complete_acknack(Packet& acknack) override {
    const Number server = ends(acknack.relation()).destination;
    if (!topology().is_server(server)) return;
    const bool of_publications = acknack.stream == Stream::pub;
    acknack.set_number_of_acknack(
        next_acknack(server, of_publications ? relay::publications : relay::subscriptions));
  }
  void forget(Number pair);
};

template <class P>
requires(model::detail::is_listed<P>(server::FastDdsServer::Parts{}) &&
         !std::is_same_v<P, comp::AnnouncementTimer> &&
         !std::is_same_v<P, server::Change>) void LivingServerProtocol::renew(P part, Number n) {
  const fsm::StateId before =
      std::exchange(state(part, n), fsm::Stepper<typename P::Machine>::initial);
  constexpr bool shown = std::is_same_v<typename P::Machine, fsm::SingleShot>;
  if (!shown || before == state(part, n)) return;
  note_renewed<typename P::Machine>(ServerColumns::kind(P::owner),
                                    ServerColumns::subject(P::owner, n), before, state(part, n));
}

extern template class ServerHost<LivingServerProtocol, LivingProtocol, server::FastDdsServerLiving,
                                 LivingColumns<ServerColumns>>;

}  // namespace stormproof::model::fastdds
