// The way from events and packets to rules, what clients send to the server, and what they learn
// from it.
#include "model/fastdds/server_protocol.hpp"

#include <algorithm>
#include <memory>
#include <utility>

#include "model/fastdds/matching.hpp"
#include "model/implementations.hpp"

namespace stormproof::model::fastdds {

namespace {

constexpr std::int64_t registration_bytes = 324;
constexpr std::int64_t numbers_in_word = 32;
constexpr std::int64_t word_bytes = 4;

}  // namespace

ServerProtocol::ServerProtocol(RunState& run, Network& network)
    : Stored{run, network},
      server_{run.scenario.dds.server},
      database_{run.topology, run.scenario.dds.discovery, run.scenario.dds.server.relay},
      learners_(std::size_t{relay::count} * run.scenario.deployment.size()) {
  relays_[relay::announcements].append(database_.announcement(server_id()));
}

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
  const Number relation = relay::count * packet.pair + packet.detail;
  switch (packet.kind) {
    case PacketKind::registration:
      run_rule<comp::Received<server::Registration>>(*this, packet.pair, &packet);
      break;
    case PacketKind::registration_heartbeat:
      run_rule<comp::Received<server::RegistrationHeartbeat>>(*this, packet.pair, &packet);
      break;
    case PacketKind::registration_acknack:
      run_rule<comp::Received<server::RegistrationAckNack>>(*this, packet.pair, &packet);
      break;
    case PacketKind::relayed_acknack:
      run_rule<comp::Received<server::RelayedAckNack>>(*this, relation, &packet);
      break;
    case PacketKind::relayed:
      if (packet.relayed->has_data)
        run_rule<comp::Received<server::RelayedData>>(*this, relation, &packet);
      else if (!packet.relayed->numbers.empty())
        run_rule<comp::Received<server::Gap>>(*this, relation, &packet);
      else
        run_rule<comp::Received<server::RelayHeartbeat>>(*this, relation, &packet);
      break;
    default:
      Protocol::received(packet, receiver);
  }
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
    database_.arrive(database_.descriptor(ends(relation).source, stream_of(relation), d));
    some = true;
  });
  if (some) run_rule<comp::Happens<server::Arrives>>(*this, server_id());
}

/// Clients are told one descriptor after the other, in no order.
bool ServerProtocol::is_notified(Number pair, Stream s, Number d) const {
  const auto relation = static_cast<Number>(2 * pair + index_of(s));
  return (changes().received(relation, d / 64) >> d % 64 & 1) != 0;
}

void ServerProtocol::open_readers(Number pair) {
  for (const Stream s : streams) {
    run_rule<comp::Happens<comp::ReaderOpens>>(static_cast<Protocol&>(*this),
                                               static_cast<Number>(2 * pair + index_of(s)));
  }
}

void ServerProtocol::open_own_writer(Number relation) {
  const Number pair = run_.topology.pair(relation / relay::count).reverse;
  const Number s = relation % relay::count == relay::publications ? 0 : 1;
  run_rule<comp::Happens<rules::WriterOpens>>(static_cast<Protocol&>(*this), 2 * pair + s);
}

void ServerProtocol::take_relayed(Number relation, const Relayed& relayed) {
  Learner& reader = learner(relation);
  const auto receive = [&](std::int64_t number) {
    const auto k = static_cast<std::size_t>(number);
    if (reader.received.size() <= k) reader.received.resize(2 * k + 1);
    reader.received[k] = true;
  };
  if (relayed.has_data) {
    receive(relayed.number);
    reader.announced = std::max(reader.announced, relayed.number);
    learn(client_of(relation / relay::count), relayed);
    if (run_.ends_now()) return;
  }
  std::ranges::for_each(relayed.numbers, receive);
  if (!relayed.has_heartbeat) return;
  reader.base = std::max(reader.base, relayed.first);
  reader.announced = std::max(reader.announced, relayed.last);
}

void ServerProtocol::learn(Number client, const Relayed& relayed) {
  if (relayed.participant == client) return;  // only a mistake tells it of itself
  const Number pair = run_.topology.pair_between(relayed.participant, client);
  const Pair& p = run_.topology.pair(pair);
  if (relayed.is_announcement) {
    if (value(comp::Recognised{}, pair)) return;
    assign(comp::Recognised{}, pair, true);
    if (p.cross_host) open_liveliness(pair);
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

void ServerProtocol::send_registration(PacketKind kind, Number pair, bool initial) {
  const bool cross_host = run_.topology.pair(pair).cross_host;
  std::int64_t bytes = acknack_bytes;
  std::uint64_t* count = &generated().pdp_acknack;
  if (kind == PacketKind::registration) {
    bytes = registration_bytes;
    count = &generated().pdp_data;
  } else if (kind == PacketKind::registration_heartbeat) {
    bytes = heartbeat_to_one_bytes;
    count = &generated().pdp_heartbeat;
  }
  if (cross_host) ++*count;
  Packet packet = packet_of(kind, pair, bytes);
  packet.initial_acknack = initial;
  send(std::move(packet));
}

/// It asks for all that is missing of what is announced; an initial one claims nothing.
void ServerProtocol::send_acknack(Number relation, bool initial) {
  const Number relay = relation % relay::count;
  const bool of_announcements = relay == relay::announcements;
  Relayed acknack;
  if (!initial) {
    Learner& reader = learner(relation);
    const auto has = [&](std::int64_t number) {
      const auto k = static_cast<std::size_t>(number);
      return k < reader.received.size() && reader.received[k];
    };
    while (has(reader.base)) ++reader.base;
    acknack.base = reader.base;
    for (std::int64_t number = reader.base; number <= reader.announced; ++number) {
      if (!has(number)) acknack.numbers.push_back(number);
    }
  }
  std::int64_t bytes = acknack_bytes;
  if (!acknack.numbers.empty()) {
    const std::int64_t span = acknack.numbers.back() - acknack.numbers.front() + 1;
    bytes += word_bytes * ((span + numbers_in_word - 1) / numbers_in_word);
  }
  const Number pair = relation / relay::count;
  if (run_.topology.pair(pair).cross_host) {
    ++(of_announcements ? generated().pdp_acknack : generated().acknack);
  }
  Packet packet = packet_of(PacketKind::relayed_acknack, pair, bytes);
  packet.detail = relay;
  packet.stream = relay == relay::subscriptions ? Stream::sub : Stream::pub;
  packet.initial_acknack = initial;
  packet.use = of_announcements ? TrafficClass::spdp : TrafficClass::acknack;
  packet.relayed = std::make_shared<const Relayed>(std::move(acknack));
  send(std::move(packet));
}

}  // namespace stormproof::model::fastdds
