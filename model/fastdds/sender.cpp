// How descriptors become messages. A created descriptor is pushed at once, in a message of its own;
// what readers asked for goes through the participant's asynchronous queue, where consecutive
// descriptors of one writer to the same readers share a message. Each DATA is charged against its
// writer's piggyback budget; in the asynchronous path with all bytes that the participant has ever
// sent there, which is what turns repairs into HEARTBEATs to every matched reader.
#include <utility>

#include "model/fastdds/protocol.hpp"

namespace stormproof::model::fastdds {

void Protocol::refill(std::uint32_t w) {
  writers_[w].budget = sedp_of(participant_of(w)).piggyback_threshold_bytes.count();
}

void Protocol::pack(Message& message, std::uint32_t w, std::uint32_t d,
                    const std::vector<std::uint32_t>& readers, SendMode mode) {
  const std::int64_t bytes = timestamp_bytes + bytes_of(w, d);
  const std::int64_t limit = sedp_of(w / 2).grouping_limit_bytes.count();
  if (message.open && (message.writer != w || message.readers != readers || message.carries(d) ||
                       message.bytes + bytes > limit)) {
    flush(message, mode);
  }
  if (!message.open) {
    message.start(w, readers, run_.topology.descriptor_count(w / 2, stream_of(w)));
  }
  message.add(d, bytes);
  for (std::size_t k = 0; k < readers.size(); ++k) {
    const std::uint32_t relation = readers[k];
    if (!crosses(relation)) continue;
    const bool initial = changes().mark_generated(relation, d);
    ++(initial ? generated_.initial_data : generated_.repair_data);
    ++(initial ? message.initial_data : message.repair_data)[k];
  }
}

/// Sends a message that takes no more, and charges the DATA just added against the piggyback budget
/// of its writer.
void Protocol::charge(Message& message, std::int64_t submessage, SendMode mode) {
  const DdsProfile& dds = own_of(participant_of(message.writer)).dds;
  const std::uint32_t most = dds.version.max_data_per_message;
  if (most > 0 && message.data >= most) flush(message, mode);
  if (dds.sedp.piggyback != Piggyback::off && is_used_up(message, submessage, mode)) {
    piggyback(message, message.writer, mode);
  }
}

/// The budget of the message's writer, after a charge; or its participant has begun another group
/// since this writer's last HEARTBEAT.
bool Protocol::is_used_up(const Message& message, std::int64_t submessage, SendMode mode) {
  const std::uint32_t w = message.writer;
  const Participant& participant = participants_[participant_of(w)];
  Writer& writer = writers_[w];
  const Piggyback piggyback = sedp_of(participant_of(w)).piggyback;
  if (piggyback == Piggyback::group) {
    const std::uint64_t now = mode == SendMode::async ? participant.group_number : 0;
    return std::exchange(writer.group_number, now) != now;
  }
  const bool cumulative = piggyback == Piggyback::cumulative && mode == SendMode::async;
  writer.budget -= cumulative ? participant.sent_bytes + (message.open ? message.bytes : 0)
                              : message_header_bytes + timestamp_bytes + submessage;
  return writer.budget < 0;
}

/// What an asynchronous run of participant i has sent.
void Protocol::count_sent(std::uint32_t i, std::int64_t bytes) {
  Participant& participant = participants_[i];
  participant.sent_bytes += bytes;
  participant.group_bytes += bytes;
  const std::int64_t threshold = sedp_of(i).piggyback_threshold_bytes.count();
  if (participant.group_bytes <= threshold) return;
  participant.group_bytes -= threshold;
  ++participant.group_number;
}

/// A HEARTBEAT to every matched reader, in the message if that goes to all of them.
void Protocol::piggyback(Message& message, std::uint32_t w, SendMode mode) {
  Writer& writer = writers_[w];
  if (!message.open || message.readers != writer.readers) {
    flush(message, mode);
    message.start(w, writer.readers,
                  has_samples(w) ? 0 : run_.topology.descriptor_count(w / 2, stream_of(w)));
  }
  message.bytes += heartbeat_submessage_bytes;
  ++message.heartbeats;
  if (has_samples(w)) {
    if (message.data == 0) message.announced = samples_sent(w);  // otherwise its last one
    for (const std::uint32_t relation : writer.readers) count_control(relation);
  } else {
    message.announced = first<rules::Exists>(w);
    generated_.heartbeat += count_crossing(writer.readers);
  }
  refill(w);
}

/// Emits the message, one packet for each of its readers.
void Protocol::flush(Message& message, SendMode mode) {
  if (!message.open) return;
  message.open = false;
  if (mode == SendMode::async) {
    const std::uint32_t i = participant_of(message.writer);
    count_sent(i, message.bytes + own_of(i).statistics_bytes);
  }
  if (has_samples(message.writer)) return send_samples(message);
  if (message.data == 0) {
    PacketNumbers heartbeat;
    heartbeat.stream = stream_of(message.writer);
    heartbeat.payload_bytes = static_cast<std::uint32_t>(message.bytes);
    heartbeat.heartbeats = message.heartbeats;
    heartbeat.detail = message.announced;
    return send_to_readers(heartbeat, message.readers);
  }
  for (std::size_t k = 0; k < message.readers.size(); ++k) {
    Packet packet = packet_on(PacketKind::data, message.readers[k], message.bytes);
    packet.descriptors = DescriptorSet{message.descriptors};
    packet.initial_data = message.initial_data[k];
    packet.repair_data = message.repair_data[k];
    packet.carries_initial = packet.initial_data > 0;
    packet.carries_heartbeat = message.heartbeats > 0;
    packet.heartbeats = message.heartbeats;
    packet.detail = message.announced;
    send(std::move(packet));
  }
}

/// What is left of an asynchronous run happens when its participant does not stall any more; until
/// then it counts as requested, and its message stays open.
void Protocol::suspend(std::uint32_t i) {
  Participant& participant = participants_[i];
  std::swap(participant.unfinished, async_message_);
  async_message_.open = false;
  driver(rules::AsyncRun{}).step<fsm::single_shot::Requested>(at<rules::AsyncRun>(i), {}, i);
  network_.hold(i, run_.scheduled_aside(EventKind::async_run, i));
}

void Protocol::go_on(std::uint32_t i) {
  if (!participants_[i].unfinished.open) return;
  std::swap(participants_[i].unfinished, async_message_);
  participants_[i].unfinished.open = false;
}

}  // namespace stormproof::model::fastdds
