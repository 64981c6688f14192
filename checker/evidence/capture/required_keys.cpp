// Required and present keys.
#include "checker/evidence/capture/required_keys.hpp"

#include <algorithm>
#include <functional>
#include <limits>
#include <map>
#include <set>
#include <utility>
#include <vector>

#include "checker/evidence/capture/relayed_keys.hpp"

namespace stormproof::capture {

namespace {

/// Sequence numbers, each with the time when it was sent first.
using Times = std::map<std::int64_t, std::int64_t>;

/// Numbers that went to nobody.
struct Unseen {
  std::size_t count = 0;
  std::vector<std::int64_t> numbers{};  ///< the first of them
};

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
  std::map<GuidPrefix, Times> directed{};  ///< to one destination
  Times multicast{};

  void add_data(const Event& event, const DataEvent& data) {
    Times& times = event.destination ? directed[*event.destination] : multicast;
    times.try_emplace(data.sequence_number, event.time_ns);
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
  [[nodiscard]] Unseen unseen(std::size_t most_listed) const {
    constexpr std::int64_t most = 1 << 16;
    constexpr std::int64_t greatest = std::numeric_limits<std::int64_t>::max();
    if (last < first) return {};
    // No number reaches the greatest that there is, so that there is one behind each.
    const std::int64_t size = std::min({last - first + 1, most, greatest - first});
    const std::int64_t end = first + size;
    std::vector<bool> known(static_cast<std::size_t>(size), false);
    for (auto one = seen.lower_bound(first); one != seen.end() && *one < end; ++one) {
      known[static_cast<std::size_t>(*one - first)] = true;
    }
    take_back(end, known);
    Unseen result;
    result.count = static_cast<std::size_t>(std::count(known.begin(), known.end(), false));
    const std::size_t listed = std::min(result.count, most_listed);
    for (std::size_t k = 0; result.numbers.size() < listed; ++k) {
      if (!known[k]) result.numbers.push_back(first + static_cast<std::int64_t>(k));
    }
    return result;
  }

 private:
  /// Marks the numbers first … end − 1 that GAPs took back, each number once for all GAPs together.
  void take_back(std::int64_t end, std::vector<bool>& known) const {
    std::vector<std::pair<std::int64_t, std::int64_t>> ranges;  // without their last number
    for (const GapEvent& gap : gaps) {
      ranges.emplace_back(std::max(gap.start, first), std::min(gap.list.base, end));
      for (std::uint32_t k = 0; k < gap.list.num_bits && gap.list.base < end - k; ++k) {
        const std::int64_t number = gap.list.base + k;
        if (!gap.list.has(k) || number < std::max(gap.start, first)) continue;
        known[static_cast<std::size_t>(number - first)] = true;
      }
    }
    std::ranges::sort(ranges);
    std::int64_t next = first;
    for (const auto& [from, to] : ranges) {
      for (next = std::max(next, from); next < to; ++next) {
        known[static_cast<std::size_t>(next - first)] = true;
      }
    }
  }
};

/// Looks at one writer's descriptions, one destination after the other. What each destination got
/// by multicast is looked at once, not once for each of them.
class Descriptions {
 public:
  Descriptions(const Writer& writer, const Counting& counting)
      : writer_{writer},
        described_{writer.described()},
        unseen_{writer.unseen(most_missing_listed - counting.missing.size())} {
    for (const std::int64_t number : described_) {
      const auto sent = writer.multicast.find(number);
      if (sent == writer.multicast.end()) {
        directed_.insert(number);
      } else {
        latest_multicast_.emplace_back(sent->second, number);
      }
    }
    std::ranges::sort(latest_multicast_, std::greater{});
  }

  /// Adds to what is required and missing; `key` has the destination.
  void check(MissingKey key, Counting& counting) {
    const auto found = writer_.directed.find(key.destination);
    const Times& times = found == writer_.directed.end() ? nothing_ : found->second;
    std::size_t present = 0;
    for (const auto& [number, time_ns] : times) {
      if (!directed_.contains(number)) continue;
      ++present;
      saw(time_ns);
    }
    see_multicast(times);
    counting.required += described_.size() + unseen_.count;
    counting.missing_count += directed_.size() - present + unseen_.count;
    if (present < directed_.size() && counting.missing.size() < most_missing_listed) {
      for (const std::int64_t number : directed_) {
        if (!times.contains(number)) list(key, number, counting);
      }
    }
    for (const std::int64_t number : unseen_.numbers) {
      if (counting.missing.size() == most_missing_listed) break;
      list(key, number, counting);
    }
  }

  /// When the last of the descriptions went to its destination first.
  [[nodiscard]] std::optional<std::int64_t> last_ns() const { return last_ns_; }

 private:
  void saw(std::int64_t time_ns) { last_ns_ = std::max(last_ns_.value_or(time_ns), time_ns); }

  /// From the latest multicast on, until one that came before anything directed.
  void see_multicast(const Times& times) {
    for (const auto& [time_ns, number] : latest_multicast_) {
      const auto sent = times.find(number);
      if (sent == times.end() || sent->second >= time_ns) return saw(time_ns);
      saw(sent->second);
    }
  }

  static void list(MissingKey key, std::int64_t number, Counting& counting) {
    if (counting.missing.size() == most_missing_listed) return;
    key.sequence_number = number;
    counting.missing.push_back(key);
  }

  const Writer& writer_;
  const Times nothing_{};
  std::set<std::int64_t> described_;
  std::set<std::int64_t> directed_{};  ///< described, and not by multicast
  std::vector<std::pair<std::int64_t, std::int64_t>> latest_multicast_{};  ///< time and number
  Unseen unseen_;
  std::optional<std::int64_t> last_ns_{};
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

}  // namespace

void check_keys(const Conversation& conversation, Counting& counting) {
  const Topology& topology = conversation.topology;
  if (topology.has_server()) {
    const Participant* server = topology.server();
    if (server != nullptr) check_relayed_keys(conversation, *server, counting);
    return;  // before a server says that it is there nobody knows of anybody
  }
  std::optional<std::int64_t> last_initial_ns;
  for (const auto& [name, writer] : collect(conversation, counting.until_ns)) {
    const Participant* source = topology.find(name.first);
    if (source == nullptr) continue;
    Descriptions descriptions{writer, counting};
    for (const Participant& destination : topology.participants) {
      const bool is_required = topology.hosts > 1 ? destination.host != source->host
                                                  : destination.prefix != source->prefix;
      if (!is_required || destination.first_ns > counting.until_ns) continue;
      descriptions.check({name.first, destination.prefix, name.second, 0}, counting);
    }
    // Nothing is less than any time.
    last_initial_ns = std::max(last_initial_ns, descriptions.last_ns());
  }
  if (counting.missing_count == 0) counting.last_initial_ns = last_initial_ns;
}

}  // namespace stormproof::capture
