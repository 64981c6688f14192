// What starts at the beginning, and what goes to everybody.
#include "props/monitors/follower.hpp"

#include <utility>

#include "model/engine/endpoint_creations.hpp"
#include "model/fastdds/peer_ports.hpp"

namespace stormproof::props {

void Follower::started() {
  audit_.begin("The start");
  for (Number i = 0; i < run_.scenario.deployment.size(); ++i) {
    expect_start(i);
    take_creations(i);
  }
}

void Follower::take_creations(Number i) {
  while (const auto* creation = audit_.deeds().next<Scheduled>()) {
    if (creation->kind != model::EventKind::endpoint_creation || creation->subject != i) break;
    creations_[i].insert(creation->insertion);
    audit_.deeds().take();
  }
}

std::optional<model::Endpoint> Follower::created_by(const model::Event& event) {
  const Number i = event.subject;
  if (run_.scenario.deployment.life && creations_[i].erase(event.insertion()) == 0) return {};
  return model::creation_of(run_.topology, i, may_stall() ? created_[i]++ : event.detail);
}

void Follower::expect_from(Number i, Message message) {
  const model::Topology& topology = run_.topology;
  for (Number pair = topology.first_pair(i);
       message.is_multicast() && pair < topology.first_pair(i + 1); ++pair) {
    if (topology.pair(pair).cross_host) continue;
    message.loops_to = topology.pair(pair).destination;
    audit_.expect(message);
  }
  message.loops_to = UINT32_MAX;
  audit_.expect(message);
}

/// With static peers to the ports.
void Follower::announce(Number i) {
  if (run_.scenario.dds.discovery == model::Discovery::static_peers) return announce_to_ports(i);
  Message message;
  message.kind = model::PacketKind::spdp_multicast;
  message.pair = i;
  expect_from(i, std::move(message));
}

/// A copy to each port of every host that is asked; on one's own host, if somebody is there.
void Follower::announce_to_ports(Number i) {
  const model::Deployment& deployment = run_.scenario.deployment;
  Message message;
  message.kind = model::PacketKind::spdp_unicast;
  for (const auto& [host, there] : model::fastdds::participants_at_ports(deployment)) {
    for (Number port = 0; port < run_.profiles.of(i).peer_ports; ++port) {
      message.to_nobody = port >= there.size();
      const Number somebody = message.to_nobody ? there.front() : there[port];
      if (somebody == i) continue;
      if (message.to_nobody && host == deployment.participants[i].host) continue;
      message.pair = run_.topology.pair_between(i, somebody);
      audit_.expect(message);
    }
  }
}

}  // namespace stormproof::props
