// Two passes: which descriptor is the last of each SEDP writer, then what the events say of it.
#include "checker/evidence/validate/creation_times.hpp"

#include <algorithm>
#include <limits>
#include <set>
#include <tuple>

namespace stormproof::validate {

namespace {

using capture::EntityId;
using capture::Event;
using capture::GuidPrefix;

using WriterName = std::pair<GuidPrefix, EntityId>;

/// What is known of the creation of one SEDP writer's last descriptor.
struct Writer {
  std::int64_t last_number = std::numeric_limits<std::int64_t>::min();
  std::int64_t earliest = std::numeric_limits<std::int64_t>::min();
  std::int64_t latest = std::numeric_limits<std::int64_t>::max();
  std::int64_t announced = 0;  ///< by its HEARTBEATs so far
  std::vector<Creation> seen{};

  void exists_at(std::int64_t time_ns) { latest = std::min(latest, time_ns); }
  void is_later_than(std::int64_t time_ns) { earliest = std::max(earliest, time_ns); }
};

/// The greatest number with which an endpoint was described first: descriptions that are renewed
/// later, and those that end, are no creations.
std::map<WriterName, Writer> last_descriptors(const capture::Conversation& conversation,
                                              std::int64_t until_ns) {
  std::map<std::tuple<GuidPrefix, EntityId, capture::Guid>, std::int64_t> first;
  for (const Event& event : conversation.events) {
    if (event.time_ns > until_ns) break;
    const capture::DataEvent* data = event.data();
    if (data == nullptr || event.traffic() != capture::Traffic::sedp) continue;
    if (!data->endpoint || data->is_gone) continue;
    const auto [found, is_new] =
        first.try_emplace({event.source, event.writer, *data->endpoint}, data->sequence_number);
    if (!is_new) found->second = std::min(found->second, data->sequence_number);
  }
  std::map<WriterName, Writer> writers;
  for (const auto& [key, number] : first) {
    Writer& writer = writers[{std::get<0>(key), std::get<1>(key)}];
    writer.last_number = std::max(writer.last_number, number);
  }
  return writers;
}

/// Reads the events in the order of time.
class Evidence {
 public:
  explicit Evidence(std::map<WriterName, Writer>& writers) : writers_{writers} {}

  void add(const Event& event) {
    if (event.traffic() != capture::Traffic::sedp) return;
    if (const capture::AcknackEvent* acknack = event.acknack()) {
      note_request(event, *acknack);
      return;
    }
    const auto found = writers_.find({event.source, event.writer});
    if (found == writers_.end()) return;
    Writer& writer = found->second;
    if (const capture::HeartbeatEvent* heartbeat = event.heartbeat()) {
      writer.announced = std::max(writer.announced, heartbeat->last);
      if (heartbeat->last < writer.last_number) {
        writer.is_later_than(event.time_ns);
      } else {
        writer.exists_at(event.time_ns);
      }
    } else if (const capture::DataEvent* data = event.data()) {
      if (data->sequence_number >= writer.last_number) writer.exists_at(event.time_ns);
      if (!is_pushed(event, *data, writer)) return;
      writer.is_later_than(event.time_ns);
      const bool publishes = event.writer == capture::entity::publications_writer;
      writer.seen.push_back({publishes ? model::Stream::pub : model::Stream::sub,
                             data->sequence_number, event.time_ns});
    }
  }

 private:
  /// Writer of the relation, its reader's participant, number.
  using Key = std::tuple<GuidPrefix, EntityId, GuidPrefix, std::int64_t>;

  void note_request(const Event& event, const capture::AcknackEvent& acknack) {
    if (!event.destination) return;
    for (std::uint32_t k = 0; k < acknack.missing.num_bits; ++k) {
      if (!acknack.missing.has(k)) continue;
      requested_.insert({*event.destination, event.writer, event.source, acknack.missing.base + k});
    }
  }
  /// Whether this is the first copy of all, not announced before and not asked for.
  bool is_pushed(const Event& event, const capture::DataEvent& data, const Writer& writer) {
    const bool is_first = sent_.insert({event.source, event.writer, data.sequence_number}).second;
    if (!is_first || data.is_gone || data.sequence_number <= writer.announced) return false;
    return !event.destination || !requested_.contains({event.source, event.writer,
                                                       *event.destination, data.sequence_number});
  }

  std::map<WriterName, Writer>& writers_;
  std::set<Key> requested_;
  std::set<std::tuple<GuidPrefix, EntityId, std::int64_t>> sent_;
};

}  // namespace

std::map<GuidPrefix, CreationTimes> creation_times(const capture::Conversation& conversation,
                                                   std::int64_t until_ns) {
  std::map<WriterName, Writer> writers = last_descriptors(conversation, until_ns);
  Evidence evidence{writers};
  for (const Event& event : conversation.events) {
    if (event.time_ns > until_ns) break;
    evidence.add(event);
  }
  // The last of all endpoints is the later one of both streams, whichever that is.
  std::map<GuidPrefix, CreationTimes> result;
  for (const auto& [name, writer] : writers) {
    const std::int64_t earliest = std::min(writer.earliest, writer.latest);
    const auto [found, is_new] =
        result.try_emplace(name.first, CreationTimes{earliest, writer.latest, writer.seen});
    if (is_new) continue;
    CreationTimes& times = found->second;
    times.last_earliest = std::max(times.last_earliest, earliest);
    times.last_latest = std::max(times.last_latest, writer.latest);
    times.seen.insert(times.seen.end(), writer.seen.begin(), writer.seen.end());
  }
  for (auto& [prefix, times] : result) {
    std::ranges::stable_sort(times.seen, {}, &Creation::time_ns);
  }
  return result;
}

}  // namespace stormproof::validate
