// How samples that ask for types, and answers, become messages: as descriptors that are repaired do
// (model/fastdds/sender.cpp), but each goes to all readers of its writer, unless a filter is on.
#include "model/fastdds/lookups.hpp"

#include <algorithm>

#include "model/fastdds/protocol.hpp"

namespace stormproof::model::fastdds {

std::uint32_t Lookups::looked_up(std::uint32_t relation, std::uint32_t d) const {
  const Stream s = streams[relation % 2];
  const std::uint32_t type = types_.of(topology_.pair(relation / 2).source, s, d);
  return 2 * type + static_cast<std::uint32_t>(index_of(s));
}

bool Lookups::knows(std::uint32_t participant, std::uint32_t looked_up,
                    std::array<std::uint32_t, 2> created) const {
  const std::uint32_t type = looked_up / 2;
  if (learned_[participant].contains(type)) return true;
  for (const Stream s : streams) {
    for (std::uint32_t d = 0; d < created[index_of(s)]; ++d) {
      if (types_.of(participant, s, d) == type) return true;
    }
  }
  return false;
}

bool Lookups::waits(std::uint32_t relation, std::uint32_t d) const {
  const auto list =
      waiting_.find({topology_.pair(relation / 2).destination, looked_up(relation, d)});
  return list != waiting_.end() &&
         std::ranges::find(list->second, Waiting{relation, d}) != list->second.end();
}

std::vector<std::uint32_t> Lookups::first_ones(std::uint32_t pair, std::size_t most) {
  std::vector<std::uint32_t> types;
  for (const Stream s : streams) {
    const auto relation = static_cast<std::uint32_t>(2 * topology_.pair(pair).reverse +
                                                     static_cast<std::uint32_t>(index_of(s)));
    for (std::uint32_t d = 0; d < topology_.descriptor_count(relation); ++d) {
      if (types.size() >= most) return types;
      if (!waits(relation, d) || !is_first(relation, d)) continue;
      const std::uint32_t type = looked_up(relation, d) / 2;
      if (std::ranges::find(types, type) == types.end()) types.push_back(type);
    }
  }
  return types;
}

std::uint32_t Lookups::take(std::uint32_t participant) {
  const Sample sample = queues_[participant].front();
  queues_[participant].pop_front();
  const std::uint32_t writer = control_writers * participant + sample.stage % 2;
  histories_[writer].push_back(sample);
  return writer;
}

std::int64_t Protocol::last_sample_bytes(std::uint32_t w) const {
  const Sample& sample = lookups_.last_sample(w - first_lookup_writer_);
  return sample_bytes(own_of(participant_of(w)).dds, sample.stage,
                      lookups_.type_count(sample.looked_up));
}

void Protocol::pack_sample(std::uint32_t w, const std::vector<std::uint32_t>& readers) {
  Message& message = async_message_;
  const std::int64_t bytes = timestamp_bytes + last_sample_bytes(w);
  const std::int64_t limit = sedp_of(participant_of(w)).grouping_limit_bytes.count();
  if (message.open &&
      (message.writer != w || message.readers != readers || message.bytes + bytes > limit)) {
    flush(message, SendMode::async);
  }
  if (!message.open) message.start(w, readers, 0);
  message.bytes += bytes;
  ++message.data;
  message.announced = lookups_.sample_count(w - first_lookup_writer_);
  for (const std::uint32_t relation : readers) {
    if (run_.topology.pair(control_.pair_of(relation)).cross_host) ++generated_.lookup;
  }
}

void Protocol::charge_sample(std::uint32_t w) {
  charge(async_message_, last_sample_bytes(w), SendMode::async);
}

/// A message of such a writer; without samples it is a HEARTBEAT.
void Protocol::send_samples(const Message& message) {
  for (const std::uint32_t relation : message.readers) {
    Packet packet =
        control_.packet_of(message.data > 0 ? PacketKind::lookup : PacketKind::user_heartbeat,
                           relation, message.bytes);
    packet.set_samples(message.data, message.announced);
    if (message.data > 0) packet.heartbeats = message.heartbeats;
    send(std::move(packet));
  }
}

void Protocol::send_lookup_heartbeats(std::uint32_t w) {
  const std::vector<std::uint32_t>& readers = writers_[w].readers;
  const std::int64_t bytes = readers.size() == 1 ? heartbeat_to_one_bytes : heartbeat_to_many_bytes;
  for (const std::uint32_t relation : readers) {
    Packet packet = control_.packet_of(PacketKind::user_heartbeat, relation, bytes);
    packet.set_samples(0, samples_sent(w));
    count_control(relation);
    send(std::move(packet));
  }
}

}  // namespace stormproof::model::fastdds
