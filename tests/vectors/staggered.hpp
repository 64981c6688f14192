// What the tables of test vectors of Fast DDS and Cyclone DDS have in common: one channel, and
// participants that start one after the other, the hosts in turn, and need longer to create their
// endpoints the more there are.
#pragma once

#include <cstdint>
#include <utility>
#include <vector>

#include "model/scenario.hpp"

namespace stormproof::vectors {

/// `creation_ns`: for each endpoint of a host, default ones among them.
inline model::Scenario staggered(std::uint32_t hosts, std::uint32_t participants,
                                 std::uint32_t endpoints, std::int64_t creation_ns) {
  constexpr std::int64_t ms = 1'000'000;
  constexpr std::int64_t default_endpoints = 17;
  model::Scenario scenario;
  scenario.deployment = model::Deployment::homogeneous(hosts, participants, endpoints);
  const std::int64_t creation = participants * (default_endpoints + endpoints) * creation_ns;
  for (std::uint32_t i = 0; i < scenario.deployment.size(); ++i) {
    model::Participant& p = scenario.deployment.participants.at(i);
    const std::int64_t rank = std::int64_t{hosts} * (i % participants) + p.host.value;
    p.start = model::Nanoseconds{3 * ms + 2 * ms * rank};
    p.endpoints_done = model::Nanoseconds{p.start.count() + creation};
  }
  model::WirelessProfile& w = scenario.wireless;
  w.overhead_unicast = model::Nanoseconds{150'000};
  w.overhead_multicast = model::Nanoseconds{150'000};
  w.rate_unicast = model::BitsPerSecond{144'400'000};
  w.rate_multicast = model::BitsPerSecond{6'000'000};
  w.link_overhead_bytes = model::Bytes{14};
  w.source_queue_bytes = model::WirelessProfile::unlimited;
  w.order = model::ServiceOrder::fifo;
  w.fragment_request = model::FragmentRequest::at_admission;
  return scenario;
}

/// Start and end of the creation of each participant's endpoints, in half milliseconds.
inline model::Scenario at(model::Scenario scenario,
                          const std::vector<std::pair<std::int64_t, std::int64_t>>& times) {
  constexpr std::int64_t half_ms = 500'000;
  for (std::size_t i = 0; i < times.size(); ++i) {
    model::Participant& p = scenario.deployment.participants.at(i);
    p.start = model::Nanoseconds{times.at(i).first * half_ms};
    p.endpoints_done = model::Nanoseconds{times.at(i).second * half_ms};
  }
  return scenario;
}

template <class... Changes>
model::Scenario with(model::Scenario scenario, const Changes&... changes) {
  (changes(scenario), ...);
  return scenario;
}

}  // namespace stormproof::vectors
