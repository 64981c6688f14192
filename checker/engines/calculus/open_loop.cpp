// The sum of the flows, and the longest busy period.
#include "checker/engines/calculus/open_loop.hpp"

#include <algorithm>
#include <cstring>

#include "checker/engines/calculus/open_loop_parts.hpp"
#include "model/implementations.hpp"

namespace stormproof::calculus {

namespace {

using Add = void (*)(const model::Scenario&, const Omission&, Flows&);

Add adder_of(model::Of<fsm::composition::paper::Paper>) { return add_flows_of_the_paper; }
Add adder_of(model::Of<fsm::composition::fastdds::FastDds>) { return add_flows_of_fastdds; }

}  // namespace

void Flows::add(const char* what, model::TrafficClass traffic_class, const Recurrence& when,
                std::int64_t messages, std::int64_t each) {
  if (messages == 0) return;
  const auto found = std::ranges::find_if(traffic.flows, [&](const Flow& flow) {
    return std::strcmp(flow.what, what) == 0 && flow.traffic == traffic_class && flow.when == when;
  });
  Flow& flow = found == traffic.flows.end()
                   ? traffic.flows.emplace_back(Flow{what, traffic_class, 0, 0, when})
                   : *found;
  flow.messages = plus(flow.messages, messages);
  flow.airtime = plus(flow.airtime, times(messages, each));
}

void Flows::add_announcements(const model::SpdpProfile& spdp, std::int64_t payload_bytes,
                              ToAll to_all, std::int64_t peers, std::int64_t recognitions) {
  using model::SpdpResend;
  using model::TrafficClass;
  const std::int64_t copy = unicast(payload_bytes);
  const Recurrence schedule = Recurrence::announcements(spdp);
  add("scheduled announcements", TrafficClass::spdp, schedule, to_all.packets, to_all.each);
  add("scheduled announcements", TrafficClass::spdp, schedule, peers, copy);
  constexpr const char* answers = "announcements to new participants";
  const bool group =
      spdp.resend == SpdpResend::all_known || spdp.resend == SpdpResend::new_and_multicast;
  if (group) add(answers, TrafficClass::spdp, {}, recognitions * to_all.packets, to_all.each);
  if (spdp.resend == SpdpResend::all_known) {
    // At the k-th recognition min(k, peers) of those that are known are on other hosts, at most.
    const std::int64_t copies = peers * (peers + 1) / 2 + (recognitions - peers) * peers;
    add(answers, TrafficClass::spdp, {}, copies, copy);
  } else if (spdp.resend != SpdpResend::none) {
    add(answers, TrafficClass::spdp, {}, peers, copy);
  }
}

std::int64_t cross_peers(const model::Topology& topology, std::uint32_t i) {
  std::int64_t peers = 0;
  for (std::uint32_t pair = topology.first_pair(i); pair < topology.first_pair(i + 1); ++pair) {
    if (topology.pair(pair).cross_host) ++peers;
  }
  return peers;
}

std::int64_t rounding(const Flows& flows, std::int64_t fragments) {
  return fragments * static_cast<std::int64_t>(flows.route.stages());
}

std::int64_t OpenLoop::work(std::int64_t window, std::int64_t delay) const {
  std::int64_t sum = 0;
  for (const Flow& flow : flows) {
    sum = plus(sum, times(flow.airtime, flow.when.most(window, delay)));
  }
  return sum;
}

const char* uncovered(const model::Scenario& scenario) {
  const model::SedpProfile& sedp = scenario.dds.sedp;
  if (sedp.heartbeat_policy == model::HeartbeatPolicy::adaptive) {
    return "the HEARTBEATs of the adaptive policy have no bound here";
  }
  if (scenario.wireless.service == model::ServedBy::unit) {
    return "units of several frames (service: unit) have no bound here";
  }
  if (!scenario.deployment.hosts.empty()) {
    return "hosts that are listed (deployment.hosts) have no bound here";
  }
  if (scenario.wireless.loss) return "transmissions that fail (wireless.loss) have no bound here";
  if (scenario.hosts) return "threads that are busy (hosts) have no bound here";
  const bool stateful = model::traits_of(scenario.dds).writer == model::Writer::stateful;
  if (!stateful && sedp.initial_data == model::InitialData::pull) {
    return "DATA that readers pull has no bound here";
  }
  if (!stateful && sedp.relation_opening == model::RelationOpening::each_side) {
    return "a relation of which each side opens by itself has no bound here";
  }
  return nullptr;
}

OpenLoop open_loop(const model::Scenario& scenario, const Omission& omission) {
  Flows flows{scenario};
  model::visit_engine_composition(scenario.dds, [](auto composition) {
    return adder_of(composition);
  })(scenario, omission, flows);
  return std::move(flows.traffic);
}

std::optional<BusyPeriod> busy_period(const OpenLoop& traffic, model::Nanoseconds loopback) {
  constexpr std::uint32_t most_steps = 100'000;
  BusyPeriod busy;
  std::int64_t length = 0;
  while (++busy.steps < most_steps) {
    const std::int64_t next = traffic.work(length, std::max(length, loopback.count()));
    if (next > hour) return std::nullopt;
    if (next <= length) {
      busy.length = model::Nanoseconds{length};
      return busy;
    }
    length = next;
  }
  return std::nullopt;
}

}  // namespace stormproof::calculus
