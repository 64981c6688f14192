// Who hears whom, and what is lost of those that the server or a client forgets.
#include "model/fastdds/living_server_protocol.hpp"

#include "model/fastdds/server_packets.hpp"

namespace stormproof::model::fastdds {

template class ServerHost<LivingServerProtocol, LivingProtocol, server::FastDdsServerLiving,
                          LivingColumns<ServerColumns>>;

/// Discovery waits for nothing of those that are gone some day.
LivingServerProtocol::LivingServerProtocol(RunState& run, Network& network)
    : ServerHost{run, network} {
  for (Number pair = 0; pair < topology().pair_count(); ++pair) {
    const Pair& ends = topology().pair(pair);
    if (waits_for(ends.source) && waits_for(ends.destination)) continue;
    run.missing -= topology().matching_descriptors(ends.source, ends.destination,
                                                   run.scenario.dds.descriptors);
  }
}

void LivingServerProtocol::start() {
  ServerHost::start();
  for (Number k = 0; k < topology().server_count(); ++k) {
    start_announcing(topology().first_server() + k);
  }
}

void LivingServerProtocol::handle(const Event& event) {
  const std::optional<Number> actor = sender_of(event);
  if (actor && is_away(life_, *actor, run_.now)) return;
  ServerHost::handle(event);
}

void LivingServerProtocol::received(const Packet& packet, Number receiver) {
  const Pair& ends = topology().pair(packet.pair);
  const Number sender = packet.to_writer() ? ends.destination : ends.source;
  if (hears(run_.scenario.deployment, sender, receiver, packet.emitted, run_.now))
    ServerHost::received(packet, receiver);
}

void LivingServerProtocol::forget_exchange(Number pair) {
  RunningWorld<LivingProtocol, comp::owner::pair>{*this, pair}.call(rules::Life::Forget{});
}

/// A reader has lost all, or has these.
void LivingServerProtocol::take_descriptors(Number relation, const DescriptorSet& received) {
  if (received.empty()) {
    lose(changes(), relation, false);
  } else {
    ServerHost::take_descriptors(relation, received);
  }
}

/// The pair's destination has heard from the server that its source is gone.
void LivingServerProtocol::forget(Number pair) {
  if (!value(comp::Recognised{}, pair)) return;
  const Pair& ends = topology().pair(pair);
  for (const Stream s : streams) {
    for (Number d = 0; d < topology().descriptor_count(ends.source, s); ++d) {
      if (is_required(ends, s, d) && is_notified(pair, s, d)) ++run_.missing;
    }
  }
  forget_exchange(pair);
}

/// Of somebody whom the client does not know it takes nothing but announcements.
void LivingServerProtocol::learn(Number client, const Relayed& relayed) {
  if (relayed.participant == client) return;
  const Number pair = topology().pair_between(relayed.participant, client);
  if (relayed.is_goodbye) return forget(pair);
  if (!relayed.is_announcement && !value(comp::Recognised{}, pair)) return;
  ServerHost::learn(client, relayed);
}

}  // namespace stormproof::model::fastdds
