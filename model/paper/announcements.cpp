// What an announcement is on the wire: copies to all that a participant knows are one record.
#include "model/paper/protocol.hpp"

namespace stormproof::model::paper {

/// To every cross-host participant that i knows: one record that stands for all copies.
void ProtocolBase::send_spdp_to_known(std::uint32_t i) {
  const Participant& participant = participants_[i];
  if (participant.known == 0) return;
  if (forgets_) {
    for (std::uint32_t pair = topology().first_pair(i); pair < topology().first_pair(i + 1);
         ++pair) {
      if (known_rank_[pair] != no_rank) send_spdp_copy(pair);
    }
    return;
  }
  run_.counts.spdp_unicast += participant.known;
  Packet packet = packet_of(PacketKind::spdp_unicast, participant.first_known_pair,
                            spdp_.payload_bytes.count());
  packet.copies = participant.known;
  packet.rank_limit = participant.known;
  network_.emit(i, std::move(packet));
}

void ProtocolBase::send_spdp_multicast(std::uint32_t i) {
  ++run_.counts.spdp_multicast;
  network_.emit(i, packet_of(PacketKind::spdp_multicast, i, spdp_.payload_bytes.count()));
}

void ProtocolBase::send_spdp_copy(std::uint32_t pair) {
  ++run_.counts.spdp_unicast;
  network_.emit(run_.topology.pair(pair).source,
                packet_of(PacketKind::spdp_unicast, pair, spdp_.payload_bytes.count()));
}

}  // namespace stormproof::model::paper
