// See workloads.hpp.
#include "tests/bench/workloads.hpp"

#include <algorithm>

namespace stormproof::bench {

using model::Nanoseconds;

model::Scenario homogeneous(std::uint32_t hosts, std::uint32_t participants,
                            std::uint32_t endpoints) {
  model::Scenario scenario;
  scenario.deployment = model::Deployment::homogeneous(hosts, participants, endpoints);
  return scenario;
}

model::Scenario live(std::uint32_t participants, std::uint32_t endpoints, std::uint64_t seed) {
  model::Scenario scenario = homogeneous(2, participants, endpoints);
  scenario.dds.implementation = model::ImplementationKind::fastdds;
  scenario.wireless.overhead_unicast = Nanoseconds{150'000};
  scenario.wireless.overhead_multicast = Nanoseconds{150'000};
  scenario.wireless.link_overhead_bytes = model::Bytes{14};
  scenario.wireless.order = model::ServiceOrder::fifo;
  scenario.wireless.fragment_request = model::FragmentRequest::at_admission;
  scenario.wireless.source_queue_bytes = model::WirelessProfile::unlimited;
  // The live machine's endpoints are done within these times, in ns.
  const std::int64_t processes = participants;
  const std::int64_t work = processes * (17 + endpoints);
  const std::int64_t earliest =
      std::max<std::int64_t>(0, -700'000 + 2'900'000 * processes + 200'000 * work);
  const std::int64_t latest =
      std::max<std::int64_t>(earliest, -27'000'000 + 15'400'000 * processes + 455'000 * work);
  scenario.deployment.schedule = {Nanoseconds{3'000'000}, Nanoseconds{12'000'000 * processes},
                                  Nanoseconds{earliest}, Nanoseconds{latest}, seed};
  scenario.deployment.draw_schedule(seed);
  return scenario;
}

model::Scenario collapse(std::uint32_t hosts, std::uint32_t participants, std::uint32_t endpoints) {
  model::Scenario scenario = homogeneous(hosts, participants, endpoints);
  scenario.time_limit = Nanoseconds{60'000'000'000};
  return scenario;
}

}  // namespace stormproof::bench
