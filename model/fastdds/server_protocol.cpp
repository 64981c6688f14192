// The way from events and packets to rules, and what clients learn from the server.
#include "model/fastdds/server_protocol.hpp"

#include <algorithm>
#include <utility>

#include "model/fastdds/matching.hpp"
#include "model/implementations.hpp"

namespace stormproof::model::fastdds {

ServerProtocol::ServerProtocol(RunState& run, Network& network)
    : Stored{run, network}, ServerSteps{run} {}

void ServerProtocol::begin_announcing(Number i) {
  schedule(server::ClientAnnouncement{}, run_.topology.pair_between(i, server_id()),
           run_.topology.start(i).count());
}

void ServerProtocol::handle(const Event& event) {
  if (!run_due(*this, event)) Protocol::handle(event);
}

std::optional<std::uint32_t> ServerProtocol::sender_of(const Event& event) const {
  const std::optional<std::uint32_t> actor = actor_of_timer(*this, event);
  return actor ? actor : Protocol::sender_of(event);
}

void ServerProtocol::count(const Packet& packet) {
  Counts& counts = run_.counts;
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
      Protocol::count(packet);
  }
}

void ServerProtocol::received(const Packet& packet, Number receiver) {
  if (run_.now < run_.topology.start(receiver)) return;
  if (!ServerSteps::take_in(packet)) Protocol::received(packet, receiver);
}

/// Whether discovery needs that the pair's destination learns the descriptor: it has the other side
/// of its topic.
bool ServerProtocol::is_required(const Pair& pair, Stream s, Number d) const {
  if (pair.source == server_id() || pair.destination == server_id()) return false;
  return has_other_side(run_.topology, pair.destination, s, d);
}

std::vector<MissingDescriptor> ServerProtocol::missing(std::size_t limit) {
  std::vector<MissingDescriptor> list;
  for (Number pair = 0; pair < run_.topology.pair_count(); ++pair) {
    const Pair& p = run_.topology.pair(pair);
    for (const Stream s : streams) {
      for (Number d = 0; d < run_.topology.descriptor_count(p.source, s); ++d) {
        if (!is_required(p, s, d) || is_notified(pair, s, d)) continue;
        if (list.size() == limit) return list;
        list.push_back({ParticipantId{p.source}, ParticipantId{p.destination}, s, DescriptorId{d}});
      }
    }
  }
  return list;
}

/// A reader of the server has received a client's descriptors.
void ServerProtocol::take_descriptors(Number relation, const DescriptorSet& received) {
  const DescriptorSet missing = changes().missing(relation);
  changes().receive(relation, received);
  bool some = false;
  missing.for_each([&](std::uint32_t d) {
    if ((changes().received(relation, d / 64) >> d % 64 & 1) == 0) return;
    --at<Lacking>(relation);
    arrive(ends(relation).source, stream_of(relation), d);
    some = true;
  });
  if (some) run_rule<comp::Happens<server::Arrives>>(*this, server_id());
}

/// Clients are told one descriptor after the other, in no order.
bool ServerProtocol::is_notified(Number pair, Stream s, Number d) const {
  const auto relation = static_cast<Number>(2 * pair + index_of(s));
  return (changes().received(relation, d / 64) >> d % 64 & 1) != 0;
}

void ServerProtocol::learn(Number client, const Relayed& relayed) {
  if (relayed.participant == client) return;  // only a mistake tells it of itself
  const Number pair = run_.topology.pair_between(relayed.participant, client);
  const Pair& p = run_.topology.pair(pair);
  if (relayed.is_announcement) {
    if (value(comp::Recognised{}, pair)) return;
    assign(comp::Recognised{}, pair, true);
    open_builtin(pair);
    return;
  }
  const Number d = relayed.descriptor;
  const bool required = is_required(p, relayed.stream, d);
  if (is_notified(pair, relayed.stream, d)) {
    if (required) ++run_.duplicate_deliveries;
    return;
  }
  const auto relation = static_cast<Number>(2 * pair + index_of(relayed.stream));
  DescriptorSet one;
  one.add(d / 64, std::uint64_t{1} << d % 64);
  changes().receive(relation, one);
  if (required) {
    ++run_.useful_deliveries;
    if (--run_.missing == 0) {
      run_.last_delivered = {ParticipantId{p.source}, ParticipantId{p.destination}, relayed.stream,
                             DescriptorId{d}};
    }
    if (run_.ends_now()) return;
  }
  if (p.cross_host) open_notified(pair, relayed.stream, d);
}

}  // namespace stormproof::model::fastdds
