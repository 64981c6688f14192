// Counts what readers on the own host can have asked for.
#include "checker/evidence/conform/same_host.hpp"

#include <algorithm>

#include "checker/evidence/conform/requests.hpp"
#include "model/fastdds/endpoints.hpp"

namespace stormproof::conform {

namespace fastdds = model::fastdds;

namespace {

/// A DATA in a message of its own.
std::int64_t largest_message(const model::DdsProfile& dds) {
  return fastdds::message_header_bytes + fastdds::destination_bytes + fastdds::timestamp_bytes +
         fastdds::largest_submessage_bytes(dds) + dds.version.statistics_bytes.count();
}

/// When the writers of the participant are known to have created their last descriptor.
std::int64_t last_creation(const Dialogue& dialogue, std::size_t participant) {
  std::array<std::uint32_t, 2> known{};
  std::array<std::int64_t, 2> since{INT64_MIN, INT64_MIN};
  for (const Relation& relation : dialogue.relations) {
    if (relation.place.source != participant) continue;
    if (kind_of(dialogue, relation.place) != RelationKind::descriptors) continue;
    const std::size_t s = stream_index(relation.place.writer);
    for (const Submessage& one : relation.sent) {
      const std::uint32_t exist = one.descriptor  ? *one.descriptor + 1
                                  : one.heartbeat ? one.heartbeat->announced
                                                  : 0;
      if (exist < known[s]) continue;
      since[s] = exist > known[s] ? one.time_ns : std::min(since[s], one.time_ns);
      known[s] = exist;
    }
  }
  return std::max(since[0], since[1]);
}

}  // namespace

SameHost::SameHost(const Dialogue& dialogue, std::size_t participant, const model::DdsProfile& dds,
                   const Bounds& bounds)
    : is_cumulative_{dds.sedp.piggyback == model::Piggyback::cumulative},
      threshold_{dds.sedp.piggyback_threshold_bytes.count()},
      largest_message_{largest_message(dds)},
      most_unflushed_{dds.sedp.piggyback == model::Piggyback::group
                          ? dds.sedp.grouping_limit_bytes.count()
                          : 0} {
  const auto& participants = dialogue.conversation.topology.participants;
  std::int64_t begins = last_creation(dialogue, participant);
  for (std::size_t j = 0; j < participants.size(); ++j) {
    if (participants[j].host != participants[participant].host) continue;
    if (j != participant && dialogue.has_neighbour[participant]) ++readers_;
    if (dialogue.announcements[j].empty())
      begins = INT64_MAX;  // nobody knows when
    else
      begins = std::max(begins, dialogue.announcements[j].front().time_ns);
  }
  const std::int64_t takes = bounds.most_same_host_ns + bounds.most_send_lag_ns;
  until_ns_ = begins > INT64_MAX - takes ? INT64_MAX : begins + takes;
  for (std::size_t s = 0; s < streams_.size(); ++s) {
    Stream& stream = streams_[s];
    stream.descriptors = dialogue.descriptors[participant][s];
    stream.asked = stream.descriptors;  // what is pushed
    stream.in_between = most_in_between(0);
  }
}

std::int64_t SameHost::most_in_between(std::int64_t captured_bytes) const {
  const std::int64_t least = fastdds::message_header_bytes + fastdds::timestamp_bytes +
                             (is_cumulative_ ? captured_bytes : 0);
  return (threshold_ + most_unflushed_) / least + 1;
}

void SameHost::heartbeat(std::size_t stream, std::uint32_t count, std::int64_t captured_bytes) {
  Stream& one = streams_[stream];
  const std::int64_t more = std::int64_t{count} - one.count;
  if (more <= 0) return;
  one.count = count;
  one.sent += more * one.in_between;
  one.asked += more * readers_ * one.descriptors;
  one.in_between = most_in_between(captured_bytes);
}

std::int64_t SameHost::most_sent_bytes() const {
  if (readers_ == 0) return 0;
  std::int64_t sent = 0;
  for (const Stream& one : streams_) sent += std::min(one.sent + one.in_between, one.asked);
  return sent * largest_message_;
}

std::optional<std::int64_t> SameHost::needed(std::size_t stream, std::uint32_t count,
                                             std::int64_t time_ns, std::int64_t left,
                                             std::int64_t before) const {
  if (!is_active(time_ns)) return std::nullopt;
  const Stream& one = streams_[stream];
  const std::int64_t data = std::max<std::int64_t>(left, 0) / (before + largest_message_) + 1;
  // Those before it that were not captured went to the own host, too.
  const std::int64_t unseen = std::max<std::int64_t>(std::int64_t{count} - 1 - one.count, 0);
  if (one.supposed + data > one.asked + unseen * readers_ * one.descriptors) return std::nullopt;
  return data;
}

}  // namespace stormproof::conform
