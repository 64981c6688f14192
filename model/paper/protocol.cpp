// Construction, the dispatch of events and packets to the rules, and the list of what is missing.
#include "model/paper/protocol.hpp"

namespace stormproof::model::paper {

namespace reader = fsm::discovery_reader;

Protocol::Protocol(RunState& run, Network& network)
    : DiscoveryBase{run, network, Multicast::first,
                    run.scenario.dds.sedp.unmatched == Unmatched::accept ||
                        run.scenario.dds.sedp.relation_opening != RelationOpening::each_side},
      descriptors_{run},
      participants_(run.topology.participant_count()),
      writers_(2 * std::size_t{run.topology.participant_count()}),
      relations_(run.topology.relation_count()),
      known_rank_(run.topology.pair_count(), no_rank),
      sizes_{run.scenario.dds.descriptors} {
  using ReaderStates = fsm::Reflect<fsm::DiscoveryReader>;
  for (std::uint32_t relation = 0; relation < relations_.size(); ++relation) {
    const std::uint32_t count = run.topology.descriptor_count(relation);
    relations_[relation].missing = count;
    relations_[relation].unacknowledged = count;
    relations_[relation].reader =
        count > 0 ? ReaderStates::id<reader::Unknown> : ReaderStates::id<reader::EarlyComplete>;
  }
  for (std::uint32_t w = 0; w < writers_.size(); ++w) {
    writers_[w].budget = sedp_.piggyback_threshold_bytes.count();
    writers_[w].waiting_readers.resize(words_for(run.topology.peer_count(w / 2)));
  }
}

void Protocol::start() {
  for (std::uint32_t i = 0; i < run_.topology.participant_count(); ++i) {
    announcements_.start(i);
  }
}

void Protocol::handle(const Event& event) {
  switch (event.kind) {
    case EventKind::repair_generation:
      repair_generation(event.subject);
      break;
    case EventKind::suppression_end:
      suppression_end(event.subject);
      break;
    default:
      DiscoveryBase::handle(event);
      break;
  }
}

bool Protocol::has_started(std::uint32_t participant) const {
  return run_.now >= run_.topology.start(participant);
}

void Protocol::received(const Packet& packet, std::uint32_t) {
  if (packet.multicast()) {
    // `pair` of a multicast packet is its source; every started cross-host participant processes
    // it.
    const std::uint32_t end = run_.topology.first_pair(packet.pair + 1);
    for (std::uint32_t pair = run_.topology.first_pair(packet.pair); pair < end; ++pair) {
      if (has_started(run_.topology.pair(pair).destination)) spdp_received(pair);
    }
    return;
  }
  const Pair& pair = run_.topology.pair(packet.pair);
  const bool to_writer = packet.kind == PacketKind::acknack;
  if (!has_started(to_writer ? pair.source : pair.destination)) return;
  switch (packet.kind) {
    case PacketKind::spdp_unicast:
      spdp_received(packet.pair);
      break;
    case PacketKind::data:
      data_received(packet);
      break;
    case PacketKind::heartbeat:
      heartbeat_received(packet.relation());
      break;
    case PacketKind::acknack:
      acknack_received(packet);
      break;
    default:
      break;
  }
}

std::uint32_t Protocol::next_recipient(const Packet& packet, std::uint32_t pair) const {
  if (packet.kind == PacketKind::spdp_unicast) {
    while (known_rank_[pair] >= packet.rank_limit) ++pair;
    return pair;
  }
  const auto stream = static_cast<std::uint32_t>(packet.stream);
  while (relations_[2 * pair + stream].open_rank >= packet.rank_limit) ++pair;
  return pair;
}

bool Protocol::needs_heartbeat(std::uint32_t w) const { return writers_[w].unacknowledged > 0; }

std::vector<std::uint32_t> Protocol::unacknowledged(std::uint32_t w) const {
  std::vector<std::uint32_t> relations;
  const std::vector<std::uint64_t>& words = writers_[w].waiting_readers;
  const std::uint32_t first_pair = run_.topology.first_pair(w / 2);
  for (std::size_t k = 0; k < words.size(); ++k) {
    for (std::uint64_t bits = words[k]; bits != 0; bits &= bits - 1) {
      const auto peer =
          static_cast<std::uint32_t>(64 * k) + static_cast<std::uint32_t>(std::countr_zero(bits));
      relations.push_back(2 * (first_pair + peer) + w % 2);
    }
  }
  return relations;
}

bool Protocol::is_unacknowledged(std::uint32_t relation) const {
  return relations_[relation].unacknowledged > 0;
}

std::uint32_t Protocol::announced(std::uint32_t w) const {
  return run_.topology.descriptor_count(w / 2, stream_of(w));
}

std::vector<MissingDescriptor> Protocol::missing(std::size_t limit) {
  return descriptors_.list_missing(limit);
}

}  // namespace stormproof::model::paper
