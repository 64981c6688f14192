// What Fast DDS's readers ask for without need. Where pushed DATA arrives before all that could
// tell of it, only what is pulled is listed by ACKNACKs: from the first one that lists it, whose
// DATA is there within 2D + τ_N, until then. How many copies these make is limited by whatever is
// slowest: the reader's response, the writer's nack response, its suppression, or the HEARTBEATs.
#include <algorithm>

#include "checker/engines/calculus/closed_loop_parts.hpp"
#include "checker/engines/calculus/threshold.hpp"
#include "model/fastdds/endpoints.hpp"

namespace stormproof::calculus {

namespace {

namespace fastdds = model::fastdds;
using model::Stream;
using model::TrafficClass;

class AsksOfFastDds {
 public:
  AsksOfFastDds(const Lateness& lateness, Flows& flows)
      : sedp_{lateness.scenario.dds.sedp},
        lateness_{lateness},
        at_once_{is_created_at_once(lateness.scenario.deployment)},
        flows_{flows} {}

  Repairs add_participant(std::uint32_t i) {
    const std::int64_t peers = cross_peers(flows_.topology, i);
    const std::int64_t others = lateness_.omission.same_host
                                    ? peers
                                    : std::int64_t{flows_.topology.participant_count()} - 1;
    std::int64_t created = 0;
    for (const Stream s : model::streams) created += flows_.topology.descriptor_count(i, s);
    const std::int64_t exhausted = settled([&](const Exhaustions& before) {
      const std::int64_t again = lateness_.omission.caused ? 0 : copies(before[0]);
      const std::int64_t asked = times(times(others, created), plus(1, again));
      return Exhaustions{exhaustions(created, asked), 0};
    })[0];
    const std::int64_t most = copies(exhausted);
    for (const Stream s : model::streams) {
      for (std::uint32_t d = 0; d < flows_.topology.descriptor_count(i, s); ++d) {
        flows_.add("needless repairs", TrafficClass::repair_data, {}, times(peers, most),
                   alone_in_fastdds(lateness_.scenario.dds, flows_, s, d));
      }
    }
    const std::int64_t count = times(exhausted, peers);
    flows_.add("HEARTBEATs that DATA causes", TrafficClass::heartbeat, {}, count,
               flows_.unicast(fastdds::heartbeat_to_one_bytes));
    flows_.add("ACKNACKs to these", TrafficClass::acknack, {}, count,
               flows_.unicast(fastdds::acknack_bytes + fastdds::acknack_bitmap_bytes));
    return {most, times(times(peers, created), most)};
  }

 private:
  [[nodiscard]] std::int64_t exhaustions(std::int64_t created, std::int64_t asked) const {
    return lateness_.omission.piggyback
               ? 0
               : exhaustions_of_fastdds(lateness_.scenario.dds, created, asked);
  }

  /// Needless ones of a descriptor at a reader: the first that is asked for is its first at all.
  [[nodiscard]] std::int64_t copies(std::int64_t exhausted) const {
    if (lateness_.omission.repairs) return 0;
    const std::int64_t delay = lateness_.delay.count();
    const std::int64_t nack = sedp_.nack_response_delay.count();
    const std::int64_t window = std::max<std::int64_t>(0, plus(times(2, delay), nack) - 1);
    const auto apart = [&](model::Nanoseconds spacing, std::int64_t span) {
      return spacing == model::Nanoseconds{0} ? endless : Recurrence::every(spacing).most(span, 0);
    };
    const std::int64_t expiries =
        Recurrence::every(sedp_.heartbeat_period).most(plus(window, delay), 0);
    std::int64_t heartbeats = plus(exhausted, plus(1, expiries));
    if (sedp_.initial_acknack_delay > model::Nanoseconds{0}) {
      const Recurrence replies = Recurrence::attempts(sedp_).answered().answered();
      heartbeats = plus(heartbeats, replies.most(window, delay));
    }
    std::int64_t deliveries = std::min({heartbeats, apart(sedp_.nack_response_delay, window),
                                        apart(sedp_.heartbeat_response_delay, window)});
    if (at_once_) {
      const std::int64_t suppressed = std::max<std::int64_t>(0, times(2, delay) - 2);
      deliveries = std::min(deliveries, apart(sedp_.nack_suppression_duration, suppressed));
    }
    return deliveries - 1;
  }

  const model::SedpProfile& sedp_;
  const Lateness& lateness_;
  const bool at_once_;
  Flows& flows_;
};

}  // namespace

Repairs add_repairs_of_fastdds(const Lateness& lateness, Flows& flows) {
  return added_by_all(AsksOfFastDds{lateness, flows}, flows);
}

}  // namespace stormproof::calculus
