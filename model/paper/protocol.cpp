// The state that the rules are about, the way from events and packets to rules, and the list of
// what is missing.
#include "model/paper/protocol.hpp"

#include <algorithm>

namespace stormproof::model::paper {

ProtocolBase::ProtocolBase(RunState& run, Network& network)
    : Stored{run, network},
      participants_(run.topology.participant_count()),
      writers_(2 * std::size_t{run.topology.participant_count()}),
      relations_(run.topology.relation_count()),
      known_rank_(run.topology.pair_count(), no_rank),
      spdp_{run.scenario.dds.spdp},
      sedp_{run.scenario.dds.sedp},
      sizes_{run.scenario.dds.descriptors} {
  for (std::uint32_t relation = 0; relation < relations_.size(); ++relation) {
    relations_[relation].unacknowledged = run.topology.descriptor_count(relation);
  }
  for (std::uint32_t w = 0; w < writers_.size(); ++w) {
    refill(w);
    writers_[w].waiting_readers.resize(words_for(run.topology.peer_count(w / 2)));
  }
}

void ProtocolBase::start() {
  for (std::uint32_t i = 0; i < run_.topology.participant_count(); ++i) start_announcing(i);
}

bool ProtocolBase::has_started(std::uint32_t participant) const {
  return run_.now >= run_.topology.start(participant);
}

void ProtocolBase::changed(comp::Recognised, std::uint32_t pair, bool recognised) {
  const std::uint32_t reverse = run_.topology.pair(pair).reverse;
  Participant& participant = participants_[run_.topology.pair(pair).destination];
  if (!recognised) {
    known_rank_[reverse] = no_rank;
    --participant.known;
    return;
  }
  known_rank_[reverse] = participant.known++;
  participant.first_known_pair = std::min(participant.first_known_pair, reverse);
}

void ProtocolBase::changed(rules::WriterOpen, std::uint32_t relation, bool open) {
  Writer& writer = writers_[writer_of(relation)];
  if (!open) {
    if (relations_[relation].unacknowledged > 0) {
      writer.waiting_readers[peer_of(relation) / 64] ^= std::uint64_t{1} << peer_of(relation) % 64;
      --writer.unacknowledged;
    }
    relations_[relation].open_rank = no_rank;
    --writer.open;
    return;
  }
  relations_[relation].open_rank = writer.open++;
  writer.first_open_pair = std::min(writer.first_open_pair, relation / 2);
  if (relations_[relation].unacknowledged > 0) note_waiting(relation);
}

/// The open relation's reader has begun to wait, or has acknowledged everything.
void ProtocolBase::note_waiting(std::uint32_t relation) {
  const std::uint32_t w = writer_of(relation);
  const std::uint32_t peer = peer_of(relation);
  writers_[w].waiting_readers[peer / 64] ^= std::uint64_t{1} << peer % 64;
  if (relations_[relation].unacknowledged > 0)
    ++writers_[w].unacknowledged;
  else
    --writers_[w].unacknowledged;
}

void ProtocolBase::note_acknowledged(std::uint32_t relation, bool acknowledged,
                                     std::uint64_t members) {
  Relation& r = relations_[relation];
  const bool waited = r.unacknowledged > 0;
  const auto count = static_cast<std::uint32_t>(std::popcount(members));
  r.unacknowledged += acknowledged ? -count : count;
  if (waited != (r.unacknowledged > 0) && r.open_rank != no_rank) note_waiting(relation);
}

std::uint32_t ProtocolBase::next_recipient(const Packet& packet, std::uint32_t pair) const {
  ++pair;
  if (packet.kind == PacketKind::spdp_unicast) {
    while (known_rank_[pair] >= packet.rank_limit) ++pair;
    return pair;
  }
  const auto stream = static_cast<std::uint32_t>(packet.stream);
  while (relations_[2 * pair + stream].open_rank >= packet.rank_limit) ++pair;
  return pair;
}

std::vector<std::uint32_t> ProtocolBase::open_relations(std::uint32_t w) const {
  std::vector<std::uint32_t> relations;
  for (std::uint32_t pair = run_.topology.first_pair(w / 2);
       pair < run_.topology.first_pair(w / 2 + 1); ++pair) {
    const std::uint32_t relation = 2 * pair + w % 2;
    if (relations_[relation].open_rank != no_rank) relations.push_back(relation);
  }
  return relations;
}

/// The open relations whose readers have not acknowledged everything, ascending.
std::vector<std::uint32_t> ProtocolBase::waiting(std::uint32_t w) const {
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

/// The bitmap takes four bytes for every 32 descriptors that the reader knows.
void ProtocolBase::send_acknack(std::uint32_t relation, DescriptorSet&& bitmap, bool initial,
                                std::uint32_t known, std::uint32_t answered) {
  ++run_.counts.acknack;
  Packet packet = packet_on(PacketKind::acknack, relation, sedp_.acknack_bytes.count());
  packet.descriptors = std::move(bitmap);
  packet.initial_acknack = initial;
  packet.initial_data = answered;
  packet.repair_data = known;
  if (!initial && !packet.descriptors.empty()) {
    packet.payload_bytes += 4 * ((known + 31) / 32);
  }
  network_.emit(ends(relation).destination, std::move(packet));
}

void Protocol::received(const Packet& packet, std::uint32_t) {
  take_in(*this, packet,
          [this](std::uint32_t, std::uint32_t receiver) { return has_started(receiver); });
}

void Protocol::source_completed(const Packet& packet) {
  if (packet.kind != PacketKind::data) return;
  run_rule<comp::LeftSource<rules::Data>>(*this, packet.relation(), &packet);
}

void Protocol::renew_bitmap(Packet& acknack) {
  RunningWorld<Protocol, comp::owner::relation> w{*this, acknack.relation()};
  acknack.descriptors = w.set_of(said_of<comp::Listed>(rules::Implementation::bitmap()));
}

}  // namespace stormproof::model::paper
