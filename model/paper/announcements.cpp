// SPDP: the announcement schedule, the first recognition of a participant, and the opening of the
// relations that follows from it.
#include <algorithm>

#include "model/paper/protocol.hpp"

namespace stormproof::model::paper {

/// To every cross-host participant that i knows: one record that stands for all copies.
void Protocol::send_spdp_to_known(std::uint32_t i) {
  const Participant& participant = participants_[i];
  if (participant.known == 0) return;
  run_.counts.spdp_unicast += participant.known;
  Packet packet = packet_of(PacketKind::spdp_unicast, participant.first_known_pair,
                            spdp_.payload_bytes.count());
  packet.copies = participant.known;
  packet.rank_limit = participant.known;
  network_.emit(i, std::move(packet));
}

void Protocol::send_spdp_multicast(std::uint32_t i) {
  ++run_.counts.spdp_multicast;
  network_.emit(i, packet_of(PacketKind::spdp_multicast, i, spdp_.payload_bytes.count()));
}

void Protocol::send_spdp_copy(std::uint32_t pair) {
  ++run_.counts.spdp_unicast;
  network_.emit(run_.topology.pair(pair).source,
                packet_of(PacketKind::spdp_unicast, pair, spdp_.payload_bytes.count()));
}

/// `pair` is (i, j): j has received i's announcement.
void Protocol::spdp_received(std::uint32_t pair) {
  const std::uint32_t j = run_.topology.pair(pair).destination;
  const std::uint32_t reverse = run_.topology.pair(pair).reverse;
  if (known_rank_[reverse] != no_rank) return;
  Participant& participant = participants_[j];
  known_rank_[reverse] = participant.known++;
  participant.first_known_pair = std::min(participant.first_known_pair, reverse);

  resend(reverse);
  for (const Stream s : streams) open_reader(2 * pair + static_cast<std::uint32_t>(s));
  const bool by_receiver = sedp_.relation_opening == RelationOpening::receiver;
  for (const Stream s : streams) {
    open_writer(2 * (by_receiver ? pair : reverse) + static_cast<std::uint32_t>(s));
  }
}

void Protocol::open_writer(std::uint32_t relation) {
  Relation& r = relations_[relation];
  if (r.open_rank != no_rank) return;
  const std::uint32_t w = writer_of(relation);
  Writer& writer = writers_[w];
  r.open_rank = writer.open++;
  writer.first_open_pair = std::min(writer.first_open_pair, relation / 2);
  if (r.unacknowledged > 0) {
    ++writer.unacknowledged;
    const std::uint32_t peer = relation / 2 - run_.topology.first_pair(w / 2);
    writer.waiting_readers[peer / 64] |= std::uint64_t{1} << peer % 64;
  }
  if (sedp_.initial_data == InitialData::push) {
    generate_data(relation, descriptors_.all(relation), false);
  }
  send_heartbeat(relation);
  heartbeats_.arm(w);
}

}  // namespace stormproof::model::paper
