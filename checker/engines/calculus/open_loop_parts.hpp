// What the flows of the implementations are made of.
#pragma once

#include "checker/engines/calculus/open_loop.hpp"
#include "model/airtime.hpp"
#include "model/engine/topology.hpp"

namespace stormproof::calculus {

/// Collects flows: what has one name and one recurrence is one flow.
class Flows {
 public:
  explicit Flows(const model::Scenario& scenario)
      : route{scenario.wireless},
        topology{scenario.deployment, scenario.dds.descriptors,
                 model::same_host_pairs(scenario.dds)} {}

  /// `messages` more packets, each of which takes `each` ns of airtime.
  void add(const char* what, model::TrafficClass traffic, const Recurrence& when,
           std::int64_t messages, std::int64_t each);
  /// Announcements of a participant with `peers` on other hosts, and what it sends at each of its
  /// `recognitions`. One to everybody is `to_all` packets that take `each` ns.
  struct ToAll {
    std::int64_t packets = 0;
    std::int64_t each = 0;
  };
  void add_announcements(const model::SpdpProfile& spdp, std::int64_t payload_bytes, ToAll to_all,
                         std::int64_t peers, std::int64_t recognitions);
  /// One to the group.
  [[nodiscard]] ToAll multicast(std::int64_t payload_bytes) const {
    return {1, route.packet_ns(payload_bytes, true)};
  }

  [[nodiscard]] std::int64_t unicast(std::int64_t payload_bytes) const {
    return route.packet_ns(payload_bytes, false);
  }

  const model::RouteAirtime route;
  const model::Topology topology;
  OpenLoop traffic;
};

/// Peers of participant i on other hosts.
[[nodiscard]] std::int64_t cross_peers(const model::Topology& topology, std::uint32_t i);

/// Packets that share nothing have more fragments: 1 ns for each, at each stage, for what rounding
/// may hide.
[[nodiscard]] std::int64_t rounding(const Flows& flows, std::int64_t fragments);

/// All descriptors of a writer to one reader, as the paper's writer fills packets, if no HEARTBEAT
/// divides them.
struct Generation {
  std::int64_t packets = 0;
  std::int64_t airtime = 0;
};
[[nodiscard]] Generation generation_of_the_paper(const model::Scenario& scenario,
                                                 const Flows& flows, model::Stream s,
                                                 std::uint32_t descriptors);
/// A descriptor of Fast DDS in a message of its own to one reader, ns.
[[nodiscard]] std::int64_t alone_in_fastdds(const model::DdsProfile& dds, const Flows& flows,
                                            model::Stream s, std::uint32_t d);
/// How often the two writers of a participant use up their budgets, at most: `created` descriptors
/// are charged with their own bytes; `asked` deliveries, each with all that was sent before. Every
/// exhaustion takes more than the threshold.
[[nodiscard]] std::int64_t exhaustions_of_fastdds(const model::DdsProfile& dds,
                                                  std::int64_t created, std::int64_t asked);

void add_flows_of_the_paper(const model::Scenario& scenario, const Omission& omission,
                            Flows& flows);
void add_flows_of_fastdds(const model::Scenario& scenario, const Omission& omission, Flows& flows);

}  // namespace stormproof::calculus
