// One pass over the events, with what each reader has said so far.
#include "checker/evidence/doctor/repairs.hpp"

#include <algorithm>
#include <map>
#include <set>
#include <tuple>
#include <utility>

namespace stormproof::doctor {

namespace {

using capture::Event;
using capture::GuidPrefix;

/// What one SEDP writer sent to one reader, and what that reader said of it.
struct ToReader {
  std::map<std::int64_t, std::int64_t> first_sent{};  ///< by sequence number
  std::map<std::int64_t, std::int64_t> last_sent{};
  std::int64_t acknowledged = 0;       ///< everything below
  std::set<std::int64_t> lost{};       ///< asked for although something later had come
  std::set<std::int64_t> forgotten{};  ///< sent to the reader before it began anew
};

class RepairFinder {
 public:
  void heard(const Event& event, const capture::AcknackEvent& acknack) {
    ToReader& relation = relations_[{*event.destination, event.source, event.writer}];
    const capture::SequenceNumberSet& missing = acknack.missing;
    if (missing.base < relation.acknowledged) begin_anew(relation);
    relation.acknowledged = std::max(relation.acknowledged, missing.base);
    // What lies between two requests was received: the list ends with the last that is missing.
    std::int64_t received_sent_ns = INT64_MIN;
    for (std::uint32_t k = missing.num_bits; k-- > 0;) {
      const std::int64_t number = missing.base + k;
      if (missing.has(k)) {
        const auto last = relation.last_sent.find(number);
        if (last != relation.last_sent.end() && last->second < received_sent_ns) {
          relation.lost.insert(number);
        }
      } else if (const auto first = relation.first_sent.find(number);
                 first != relation.first_sent.end()) {
        received_sent_ns = std::max(received_sent_ns, first->second);
      }
    }
  }

  void sent(std::size_t position, const Event& event, const capture::DataEvent& data,
            capture::MessageClass is) {
    if (is != capture::MessageClass::initial_data && is != capture::MessageClass::repair_data) {
      return;
    }
    ToReader& relation = relations_[{event.source, *event.destination, event.writer}];
    const std::int64_t number = data.sequence_number;
    if (is == capture::MessageClass::repair_data) {
      repairs_.kinds.emplace(position, kind_of(relation, number));
    }
    relation.first_sent.try_emplace(number, event.time_ns);
    relation.last_sent[number] = event.time_ns;
  }

  [[nodiscard]] Repairs take() { return std::move(repairs_); }

 private:
  using Key = std::tuple<GuidPrefix, GuidPrefix, capture::EntityId>;

  RepairKind kind_of(ToReader& relation, std::int64_t number) {
    const auto counted = [](std::uint64_t& count, RepairKind kind) {
      ++count;
      return kind;
    };
    if (relation.forgotten.erase(number) > 0) {
      return counted(repairs_.forgotten, RepairKind::forgotten);
    }
    if (number < relation.acknowledged) {
      return counted(repairs_.acknowledged, RepairKind::acknowledged);
    }
    if (relation.lost.erase(number) > 0) return counted(repairs_.lost, RepairKind::lost);
    return counted(repairs_.under_way, RepairKind::under_way);
  }

  static void begin_anew(ToReader& relation) {
    for (const auto& [number, time] : relation.last_sent) relation.forgotten.insert(number);
    relation.acknowledged = 0;
    relation.lost.clear();
  }

  std::map<Key, ToReader> relations_;
  Repairs repairs_;
};

}  // namespace

Repairs find_repairs(const capture::Conversation& conversation, const capture::Counting& counting,
                     std::int64_t end_ns) {
  RepairFinder finder;
  for (std::size_t k = 0; k < counting.classes.size(); ++k) {
    const Event& event = conversation.events[k];
    if (!counting.classes[k] || !event.destination || event.time_ns > end_ns) continue;
    if (const auto* acknack = event.acknack()) finder.heard(event, *acknack);
    if (const auto* data = event.data()) finder.sent(k, event, *data, *counting.classes[k]);
  }
  return finder.take();
}

}  // namespace stormproof::doctor
