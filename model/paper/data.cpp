// Generation of DATA and HEARTBEATs. DATA packets are filled with descriptors up to the grouping
// limit; each descriptor is charged against the writer's piggyback budget, and a budget that is
// used up sends a HEARTBEAT to all open relations. With the cumulative charge (Fast DDS 2.6.11
// to 3.3) every DATA is charged with all bytes that the participant has ever sent this way, so that
// after enough repairs each DATA triggers HEARTBEATs.
#include "model/paper/protocol.hpp"

namespace stormproof::model::paper {

/// The packet that is being filled.
struct ProtocolBase::Message {
  std::uint32_t relation;
  bool repair;
  bool carries_initial = false;
  std::uint16_t heartbeats = 0;
  std::uint32_t members = 0;
  std::int64_t payload_bytes = 0;
  std::vector<std::uint64_t> words;
};

void ProtocolBase::generate_data(std::uint32_t relation, const DescriptorSet& descriptors,
                                 bool repair) {
  const std::int64_t shared = sedp_.shared_header_bytes.count();
  Message message{.relation = relation, .repair = repair, .words = {}};
  message.words.resize(words_for(run_.topology.descriptor_count(relation)));

  descriptors.for_each([&](std::uint32_t d) {
    const std::int64_t bytes = sizes_.bytes(stream_of(relation), d);
    if (message.members > 0 && packet_is_full(sedp_, message.payload_bytes, bytes - shared)) {
      flush(message);
    }
    const std::int64_t added = message.members == 0 ? bytes : bytes - shared;
    const bool initial = mark_generated(relation, d);
    message.words[d / 64] |= std::uint64_t{1} << d % 64;
    message.payload_bytes += added;
    message.carries_initial = message.carries_initial || initial;
    ++message.members;
    ++(initial ? run_.counts.initial_data : run_.counts.repair_data);
    charge(message, added);
  });
  if (message.members > 0) flush(message);
}

bool ProtocolBase::uses_up_budget(std::uint32_t w, std::int64_t added_bytes) {
  const bool cumulative = sedp_.piggyback == Piggyback::cumulative;
  writers_[w].budget -= cumulative ? participants_[w / 2].sent_bytes : added_bytes;
  return writers_[w].budget < 0;
}

/// Charges the bytes just added to `message` against the piggyback budget of its writer.
void ProtocolBase::charge(Message& message, std::int64_t added_bytes) {
  if (sedp_.piggyback == Piggyback::off) return;
  const std::uint32_t w = writer_of(message.relation);
  Writer& writer = writers_[w];
  std::int64_t& sent = participants_[w / 2].sent_bytes;
  sent += added_bytes;
  if (!uses_up_budget(w, added_bytes)) return;

  refill(w);
  if (writer.open == 1) {  // the HEARTBEAT rides in the packet
    ++run_.counts.heartbeat;
    const std::int64_t bytes = sedp_.piggyback_heartbeat_bytes.count();
    message.payload_bytes += bytes;
    ++message.heartbeats;
    sent += bytes;
    return;
  }
  flush(message);
  sent += sedp_.heartbeat_bytes.count();
  send_heartbeat_to_open(w);
}

/// Emits the packet and starts a new one.
void ProtocolBase::flush(Message& message) {
  Packet packet = packet_on(PacketKind::data, message.relation, message.payload_bytes);
  packet.descriptors = DescriptorSet{message.words};
  packet.from_repair = message.repair;
  packet.carries_initial = message.carries_initial;
  packet.carries_heartbeat = message.heartbeats > 0;
  packet.heartbeats = message.heartbeats;
  network_.emit(ends(message.relation).source, std::move(packet));

  std::fill(message.words.begin(), message.words.end(), 0);
  message.members = 0;
  message.payload_bytes = 0;
  message.carries_initial = false;
  message.heartbeats = 0;
}

void ProtocolBase::refill(std::uint32_t w) {
  writers_[w].budget = sedp_.piggyback_threshold_bytes.count();
}

void ProtocolBase::send_heartbeat(std::uint32_t relation, std::uint32_t number) {
  ++run_.counts.heartbeat;
  Packet packet = packet_on(PacketKind::heartbeat, relation, sedp_.heartbeat_bytes.count());
  packet.initial_data = number;
  packet.detail = writers_[writer_of(relation)].announced;
  network_.emit(ends(relation).source, std::move(packet));
}

void ProtocolBase::send_heartbeat_to(std::uint32_t relation) {
  refill(writer_of(relation));
  send_heartbeat(relation);
}

/// The same to every open relation of the writer, ascending: one record that stands for all of
/// them.
void ProtocolBase::send_heartbeat_to_open(std::uint32_t w) {
  Writer& writer = writers_[w];
  if (writer.open == 0) return;
  if (forgets_) {
    for (const std::uint32_t relation : open_relations(w)) send_heartbeat_to(relation);
    return;
  }
  run_.counts.heartbeat += writer.open;
  refill(w);
  Packet packet = packet_on(PacketKind::heartbeat, 2 * writer.first_open_pair + w % 2,
                            sedp_.heartbeat_bytes.count());
  packet.detail = writer.announced;
  packet.copies = writer.open;
  packet.rank_limit = writer.open;
  network_.emit(w / 2, std::move(packet));
}

void ProtocolBase::send_periodic(std::uint32_t w) {
  const bool to_all = sedp_.heartbeat_recipients == HeartbeatRecipients::matched ||
                      writers_[w].unacknowledged == writers_[w].open;
  if (to_all) {
    send_heartbeat_to_open(w);
  } else {
    for (const std::uint32_t relation : waiting(w)) send_heartbeat_to(relation);
  }
}

}  // namespace stormproof::model::paper
