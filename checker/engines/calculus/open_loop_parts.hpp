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
  /// `recognitions`.
  void add_announcements(const model::SpdpProfile& spdp, std::int64_t payload_bytes,
                         std::int64_t peers, std::int64_t recognitions);

  [[nodiscard]] std::int64_t unicast(std::int64_t payload_bytes) const {
    return route.packet_ns(payload_bytes, false);
  }

  const model::RouteAirtime route;
  const model::Topology topology;
  OpenLoop traffic;
};

/// Peers of participant i on other hosts.
[[nodiscard]] std::int64_t cross_peers(const model::Topology& topology, std::uint32_t i);

void add_flows_of_the_paper(const model::Scenario& scenario, const Omission& omission,
                            Flows& flows);
void add_flows_of_fastdds(const model::Scenario& scenario, const Omission& omission, Flows& flows);

}  // namespace stormproof::calculus
