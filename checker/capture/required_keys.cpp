// Required and present keys.
#include "checker/capture/required_keys.hpp"

#include <algorithm>
#include <map>
#include <set>

namespace stormproof::capture {

namespace {

/// What a participant's SEDP writer has told, and to whom.
struct Writer {
  struct Description {
    std::int64_t sequence_number = 0;
    bool is_gone = false;
  };
  std::map<Guid, Description> latest{};  ///< of each endpoint
  std::set<std::int64_t> seen{};         ///< numbers that went to anybody
  std::vector<GapEvent> gaps{};          ///< numbers that were taken back
  std::int64_t first = 1;                ///< of the last HEARTBEAT
  std::int64_t last = 0;
  /// When each number went to a destination first; nothing: by multicast.
  std::map<std::pair<std::optional<GuidPrefix>, std::int64_t>, std::int64_t> sent{};

  void add_data(const Event& event, const DataEvent& data) {
    sent.try_emplace({event.destination, data.sequence_number}, event.time_ns);
    seen.insert(data.sequence_number);
    if (!data.endpoint) return;
    const auto [found, is_new] = latest.try_emplace(*data.endpoint);
    if (is_new || data.sequence_number > found->second.sequence_number) {
      found->second = {data.sequence_number, data.is_gone};
    }
  }

  /// Numbers that went to some receiver and are not outdated.
  [[nodiscard]] std::set<std::int64_t> described() const {
    std::set<std::int64_t> numbers;
    for (const auto& [endpoint, description] : latest) {
      if (!description.is_gone) numbers.insert(description.sequence_number);
    }
    return numbers;
  }

  /// Numbers that the last HEARTBEAT announced, that went to nobody, and that no GAP took back. A
  /// range of more than 65,536 numbers is no description of real endpoints; its rest is not
  /// looked at.
  [[nodiscard]] std::vector<std::int64_t> unseen() const {
    constexpr std::int64_t most = 1 << 16;
    std::vector<std::int64_t> numbers;
    const std::int64_t size = last >= first ? std::min(last - first, most) + 1 : 0;
    for (std::int64_t k = 0; k < size; ++k) {
      const std::int64_t number = first + k;
      if (seen.contains(number)) continue;
      if (std::ranges::none_of(gaps, [number](const GapEvent& gap) { return has(gap, number); })) {
        numbers.push_back(number);
      }
    }
    return numbers;
  }

  [[nodiscard]] static bool has(const GapEvent& gap, std::int64_t number) {
    if (number < gap.start) return false;
    if (number < gap.list.base) return true;
    // Unsigned, because the distance of two signed numbers may have no signed number.
    const std::uint64_t index =
        static_cast<std::uint64_t>(number) - static_cast<std::uint64_t>(gap.list.base);
    return index < SequenceNumberSet::most_bits && gap.list.has(static_cast<std::uint32_t>(index));
  }

  /// When it went to this destination first, on its own or by multicast.
  [[nodiscard]] std::optional<std::int64_t> sent_at(const GuidPrefix& destination,
                                                    std::int64_t number) const {
    const auto directed = sent.find({destination, number});
    const auto multicast = sent.find({std::nullopt, number});
    if (directed == sent.end() && multicast == sent.end()) return std::nullopt;
    if (directed == sent.end()) return multicast->second;
    if (multicast == sent.end()) return directed->second;
    return std::min(directed->second, multicast->second);
  }
};

using Writers = std::map<std::pair<GuidPrefix, EntityId>, Writer>;

Writers collect(const Conversation& conversation, std::int64_t until_ns) {
  Writers writers;
  for (const Event& event : conversation.events) {
    if (event.time_ns > until_ns) break;
    if (event.traffic() != Traffic::sedp) continue;
    // Unicast to nobody that is known is present for nobody.
    if (!event.destination && !event.is_multicast) continue;
    if (event.acknack() != nullptr) continue;
    Writer& writer = writers[{event.source, event.writer}];
    if (const DataEvent* data = event.data(); data != nullptr && data->fragment <= 1) {
      writer.add_data(event, *data);
    } else if (const HeartbeatEvent* heartbeat = event.heartbeat()) {
      writer.first = std::max<std::int64_t>(heartbeat->first, 1);
      writer.last = std::max<std::int64_t>(heartbeat->last, 0);
    } else if (const GapEvent* gap = event.gap()) {
      writer.gaps.push_back(*gap);
    }
  }
  return writers;
}

void add_missing(Counting& counting, const MissingKey& key) {
  ++counting.missing_count;
  if (counting.missing.size() < most_missing_listed) counting.missing.push_back(key);
}

}  // namespace

void check_keys(const Conversation& conversation, Counting& counting) {
  const Topology& topology = conversation.topology;
  std::optional<std::int64_t> last_initial_ns;
  for (const auto& [name, writer] : collect(conversation, counting.until_ns)) {
    const Participant* source = topology.find(name.first);
    if (source == nullptr) continue;
    const std::set<std::int64_t> described = writer.described();
    const std::vector<std::int64_t> unseen = writer.unseen();
    for (const Participant& destination : topology.participants) {
      const bool is_required = topology.hosts > 1 ? destination.host != source->host
                                                  : destination.prefix != source->prefix;
      if (!is_required || destination.first_ns > counting.until_ns) continue;
      const MissingKey key{name.first, destination.prefix, name.second, 0};
      counting.required += described.size() + unseen.size();
      for (const std::int64_t number : described) {
        const auto sent = writer.sent_at(destination.prefix, number);
        if (sent) last_initial_ns = std::max(last_initial_ns.value_or(*sent), *sent);
        if (!sent) add_missing(counting, {key.source, key.destination, key.writer, number});
      }
      for (const std::int64_t number : unseen) {
        if (counting.missing.size() == most_missing_listed) break;
        counting.missing.push_back({key.source, key.destination, key.writer, number});
      }
      counting.missing_count += unseen.size();
    }
  }
  if (counting.missing_count == 0) counting.last_initial_ns = last_initial_ns;
}

}  // namespace stormproof::capture
