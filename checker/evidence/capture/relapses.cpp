// One pass over the ACKNACKs.
#include "checker/evidence/capture/relapses.hpp"

#include <algorithm>
#include <map>
#include <tuple>

namespace stormproof::capture {

namespace {

constexpr std::int64_t second_ns = 1'000'000'000;
/// Both readers of a participant that was forgotten ask again within this.
constexpr std::int64_t together_ns = 5 * second_ns;

/// What a reader has said of a writer.
struct Acknowledged {
  std::int64_t base = 0;
  std::int64_t time_ns = 0;
};

}  // namespace

std::vector<Relapse> relapses(const Conversation& conversation) {
  std::map<std::tuple<GuidPrefix, GuidPrefix, EntityId>, Acknowledged> said;
  std::map<std::pair<GuidPrefix, GuidPrefix>, std::pair<EntityId, Relapse>> alone;
  std::vector<Relapse> found;
  for (const Event& event : conversation.events) {
    const AcknackEvent* acknack = event.acknack();
    if (acknack == nullptr || !event.destination || event.is_same_host) continue;
    if (event.traffic() != Traffic::sedp) continue;
    Acknowledged& last = said[{event.source, *event.destination, event.writer}];
    const bool is_less =
        acknack->missing.base < last.base && event.time_ns - last.time_ns > second_ns;
    if (is_less) {
      const Relapse one{event.source, *event.destination, last.time_ns, event.time_ns};
      const auto other = alone.find({one.reader, one.writer});
      const bool is_both = other != alone.end() && other->second.first != event.writer &&
                           one.again_ns - other->second.second.again_ns < together_ns;
      if (is_both) {
        found.push_back(other->second.second);
        found.back().before_ns = std::max(found.back().before_ns, one.before_ns);
        alone.erase(other);
      } else {
        alone[{one.reader, one.writer}] = {event.writer, one};
      }
      last.base = 0;
    }
    last.base = std::max(last.base, acknack->missing.base);
    last.time_ns = event.time_ns;
  }
  std::ranges::stable_sort(found, {}, &Relapse::again_ns);
  return found;
}

}  // namespace stormproof::capture
