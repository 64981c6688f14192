// What the paper's readers ask for without need. Everything is pushed when a relation opens, and
// arrives within D. An ACKNACK asks for it if it is generated before; it answers a HEARTBEAT that
// left τ_A and a passage earlier, or it is an initial one. Each asks for a descriptor once.
#include <algorithm>

#include "checker/engines/calculus/closed_loop_parts.hpp"
#include "checker/engines/timeline/needless_repair.hpp"

namespace stormproof::calculus {

namespace {

using model::Stream;
using model::TrafficClass;

class AsksOfThePaper {
 public:
  AsksOfThePaper(const Lateness& lateness, Flows& flows)
      : sedp_{lateness.scenario.dds.sedp}, lateness_{lateness}, flows_{flows} {}

  Repairs add_participant(std::uint32_t i) {
    const std::int64_t peers = cross_peers(flows_.topology, i);
    const auto pushed = [&](Stream s) { return peers * flows_.topology.descriptor_count(i, s); };
    const Exhaustions exhausted = settled([&](const Exhaustions& before) {
      Exhaustions deliveries{};
      for (const Stream s : model::streams) {
        const std::int64_t again = lateness_.omission.caused ? 0 : copies(before[index_of(s)]);
        deliveries[index_of(s)] = times(pushed(s), plus(1, again));
      }
      return exhaustions(deliveries);
    });
    Repairs repairs;
    for (const Stream s : model::streams) {
      const std::int64_t most = copies(exhausted[index_of(s)]);
      const std::uint32_t descriptors = flows_.topology.descriptor_count(i, s);
      add_generations(s, descriptors, times(peers, most));
      add_heartbeats(descriptors, exhausted[index_of(s)], peers);
      repairs.copies = std::max(repairs.copies, most);
      repairs.sent = plus(repairs.sent, times(pushed(s), most));
    }
    return repairs;
  }

 private:
  /// Needless ones of a descriptor at a reader: its ACKNACKs that can list it.
  [[nodiscard]] std::int64_t copies(std::int64_t exhausted) const {
    if (lateness_.omission.repairs) return 0;
    const std::int64_t delay = lateness_.delay.count();
    const bool attempts = sedp_.initial_acknack_delay > model::Nanoseconds{0};
    const std::int64_t unheard = attempts ? Recurrence::unheard(sedp_).most(0, delay) : 0;
    const std::int64_t asks = timeline::asks_by_itself(sedp_) ? unheard : 0;
    const std::int64_t window = delay - 1 - sedp_.heartbeat_response_delay.count();
    // HEARTBEATs of the instant of a push arrive with it, at the earliest, if all take equal times.
    const bool is_link = lateness_.scenario.wireless.kind == model::ServiceKind::constant_delay;
    if (window < 0 || (is_link && lateness_.keeps_order)) return asks;
    std::int64_t heartbeats = exhausted;
    if (!lateness_.keeps_order) {
      const bool replies = sedp_.initial_acknack == model::InitialAckNackReply::heartbeat;
      const std::int64_t expiries = Recurrence::every(sedp_.heartbeat_period).most(window, 0);
      heartbeats = plus(heartbeats, plus(1 + (replies ? unheard : 0), expiries));
    }
    return plus(asks, heartbeats);
  }

  /// Each delivery is charged with its own bytes or, cumulative, with all that its participant has
  /// sent before, HEARTBEATs included.
  [[nodiscard]] Exhaustions exhaustions(const Exhaustions& deliveries) const {
    if (sedp_.piggyback == model::Piggyback::off || lateness_.omission.piggyback) return {};
    const std::int64_t largest = largest_descriptor();
    const std::int64_t step =
        largest + std::max(sedp_.heartbeat_bytes.count(), sedp_.piggyback_heartbeat_bytes.count());
    const std::int64_t all = plus(deliveries[0], deliveries[1]);
    const std::int64_t sums = times(times(all, plus(all, 1)) / 2, step);
    Exhaustions exhausted{};
    for (std::size_t s = 0; s < exhausted.size(); ++s) {
      const bool cumulative = sedp_.piggyback == model::Piggyback::cumulative;
      const std::int64_t charged = times(deliveries[s], cumulative ? times(all, step) : largest);
      exhausted[s] = std::min(deliveries[s], std::min(charged, cumulative ? sums : charged) /
                                                 plus(sedp_.piggyback_threshold_bytes.count(), 1));
    }
    return exhausted;
  }
  [[nodiscard]] std::int64_t largest_descriptor() const {
    const model::DescriptorProfile& profile = lateness_.scenario.dds.descriptors;
    return std::max({profile.default_bytes[0], profile.default_bytes[1], profile.user_bytes})
        .count();
  }

  /// Each generation resends a part of the writer's descriptors in no more packets than all of them
  /// take; whatever their bounds are, a packet has at most one fragment that is not full.
  void add_generations(Stream s, std::uint32_t descriptors, std::int64_t count) {
    const Generation all = generation_of_the_paper(lateness_.scenario, flows_, s, descriptors);
    const std::int64_t divided = flows_.unicast(0) + rounding(flows_, 2);
    flows_.add("needless repairs", TrafficClass::repair_data, {}, count,
               all.airtime + times(all.packets, divided));
  }

  /// Those that DATA causes; each ends a packet, or rides in it.
  void add_heartbeats(std::int64_t descriptors, std::int64_t exhausted, std::int64_t peers) {
    const std::int64_t count = times(exhausted, peers);
    const std::int64_t listed = sedp_.acknack_bytes.count() + 4 * ((descriptors + 31) / 32);
    flows_.add("HEARTBEATs that DATA causes", TrafficClass::heartbeat, {}, count,
               flows_.unicast(sedp_.heartbeat_bytes.count()));
    flows_.add("ACKNACKs to these", TrafficClass::acknack, {}, count, flows_.unicast(listed));
    const std::int64_t more =
        sedp_.shared_header_bytes.count() + sedp_.piggyback_heartbeat_bytes.count();
    flows_.add("DATA that these divide", TrafficClass::initial_data, {}, exhausted,
               flows_.unicast(more) + rounding(flows_, 2));
  }

  const model::SedpProfile& sedp_;
  const Lateness& lateness_;
  Flows& flows_;
};

}  // namespace

Repairs add_repairs_of_the_paper(const Lateness& lateness, Flows& flows) {
  return added_by_all(AsksOfThePaper{lateness, flows}, flows);
}

}  // namespace stormproof::calculus
