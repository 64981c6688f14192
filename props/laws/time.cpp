// Laws of time: another origin, and another unit.
//
// Scaling: with all durations × c and all rates / c a run takes c times as long, and does the same.
// The airtime O + round(8·10⁹·B/R) of a fragment of B bytes scales exactly if
// round(c·8·10⁹·B/R) = c·round(8·10⁹·B/R); for every B if R divides 8·10⁹, so that a byte takes
// whole nanoseconds. With other rates fragments are off by up to c/2 ns, and one nanosecond is
// enough to turn two events around (specs/findings/time-scaling.md). Three rules have a unit of
// their own and are left out: the adaptive policy rounds its periods and starts a cycle 1 ns later;
// Fast DDS's control-only relations answer after 5 ms, so with it, and with its Discovery Server,
// packets must not share a channel with them, nor be numbered among them (losses); and its
// endpoints are created at divided times.
#include <algorithm>

#include "model/engine/topology.hpp"
#include "props/laws/families.hpp"
#include "props/laws/run_log.hpp"

namespace stormproof::props {

namespace {

using model::BitsPerSecond;
using model::Nanoseconds;
using model::Scenario;
using Broken = std::optional<std::string>;

constexpr std::int64_t time_scale = 10;
constexpr Nanoseconds shift{123'456'789};

Broken translation(const Scenario& scenario, const Simulate& simulate) {
  Scenario later = scenario;
  later.time_limit += shift;
  for (model::Participant& p : later.deployment.participants) {
    p.start += shift;
    p.endpoints_done += shift;
    if (p.open) *p.open += shift;
    if (p.ready) *p.ready += shift;
  }
  Reading reading;
  reading.time_shift = shift;
  return run_difference(scenario, later, simulate, reading);
}

/// The next slower rate (the next faster below that) at which a byte takes a whole number of
/// nanoseconds, and does so at `time_scale` times that rate's inverse, too.
BitsPerSecond whole(BitsPerSecond rate) {
  constexpr std::int64_t bits = 8'000'000'000;
  std::int64_t best = time_scale;
  for (std::int64_t fives = 1; fives <= bits / time_scale; fives *= 5) {
    for (std::int64_t slow = fives; slow <= bits / time_scale; slow *= 2) {
      if (bits % slow != 0 || bits / slow % time_scale != 0) continue;
      const std::int64_t candidate = bits / slow;  // in bit/s: `slow` nanoseconds a byte
      const bool fits = candidate <= rate.count();
      if (fits ? candidate > best || best > rate.count() : best > rate.count() && candidate < best)
        best = candidate;
    }
  }
  return BitsPerSecond{best};
}

template <class Change>
void for_each_rate(Scenario& scenario, Change&& change) {
  model::WirelessProfile& wireless = scenario.wireless;
  change(wireless.rate_unicast);
  change(wireless.rate_multicast);
  for (model::Stage& stage : wireless.stages) {
    if (stage.rate_unicast) change(*stage.rate_unicast);
    if (stage.rate_multicast) change(*stage.rate_multicast);
  }
}

/// The scenario with values that scale exactly.
Scenario with_scalable_times(Scenario scenario) {
  for_each_rate(scenario, [](BitsPerSecond& rate) { rate = whole(rate); });
  scenario.dds.sedp.heartbeat_policy = model::HeartbeatPolicy::periodic;
  scenario.deployment.send_cost = scenario.deployment.cost_to_send();
  if (traits_of(scenario).has_control_relations) {  // their packets change the numbers of others
    scenario.wireless.lost_packets.clear();
    scenario.wireless.packet_delays.clear();
  }
  if (!traits_of(scenario).creates_endpoints_over_time) return scenario;
  const model::DescriptorProfile& defaults = scenario.dds.descriptors;
  for (model::Participant& p : scenario.deployment.participants) {
    const std::int64_t count = std::int64_t{defaults.default_publications} +
                               defaults.default_subscriptions + p.publications + p.subscriptions;
    const std::int64_t step = (p.endpoints_done - p.start).count() / count;
    p.endpoints_done = p.start + Nanoseconds{step * count};
  }
  return scenario;
}

template <class Change>
void for_each_duration(Scenario& scenario, Change&& change) {
  model::SpdpProfile& spdp = scenario.dds.spdp;
  change(spdp.period);
  change(spdp.startup_period);
  model::SedpProfile& sedp = scenario.dds.sedp;
  for (Nanoseconds* timer :
       {&sedp.heartbeat_period, &sedp.heartbeat_response_delay, &sedp.nack_response_delay,
        &sedp.nack_suppression_duration, &sedp.initial_acknack_delay}) {
    change(*timer);
  }
  model::WirelessProfile& wireless = scenario.wireless;
  change(wireless.overhead_unicast);
  change(wireless.overhead_multicast);
  change(wireless.one_way);
  for (model::PacketDelay& delay : wireless.packet_delays) {
    change(delay.leaves_after);
    change(delay.one_way);
  }
  for (model::Stage& stage : wireless.stages) {
    if (stage.overhead_unicast) change(*stage.overhead_unicast);
    if (stage.overhead_multicast) change(*stage.overhead_multicast);
  }
  for (model::Participant& p : scenario.deployment.participants) {
    change(p.start);
    change(p.endpoints_done);
  }
  model::ServerProfile& server = scenario.dds.server;
  for (Nanoseconds* timer :
       {&server.client_sync_period, &server.server_routine_period, &server.pdp_heartbeat_period,
        &server.pdp_nack_response_delay, &server.pdp_nack_suppression_duration,
        &server.pdp_heartbeat_response_delay}) {
    change(*timer);
  }
  change(*scenario.deployment.send_cost);
  change(scenario.deployment.loopback_delay);
  change(scenario.time_limit);
}

bool has_one_unit(const Scenario& scenario) {
  if (!is_of_two_writers(scenario) && !traits_of(scenario).has_server) return false;
  return !traits_of(scenario).has_control_relations ||
         scenario.wireless.kind == model::ServiceKind::constant_delay;
}

Broken time_scaling(const Scenario& scenario, const Simulate& simulate) {
  const Scenario one = with_scalable_times(scenario);
  Scenario other = one;
  for_each_duration(other, [](Nanoseconds& duration) { duration = duration * time_scale; });
  for_each_rate(other,
                [](BitsPerSecond& rate) { rate = BitsPerSecond{rate.count() / time_scale}; });
  Reading reading;
  reading.time_factor = time_scale;
  RunLog first{reading};
  RunLog second;
  const model::RunResult a = simulate(one, &first);
  const model::RunResult b = simulate(other, &second);
  // The control-only relations keep their 5 ms, so the events as a whole do not scale.
  if (!traits_of(one).has_control_relations) {
    if (Broken difference = first_difference(first, second)) return difference;
  }
  if (was_cut_off(a) || was_cut_off(b)) return std::nullopt;
  return result_difference(a, b, reading);
}

constexpr Law time_list[] = {
    {"law.time-translation", "If everybody starts later by t, everything happens later by t.",
     always, translation},
    {"law.time-scaling",
     "With durations × c and rates / c the run is the same, c times as slow (periodic policy, "
     "whole nanoseconds per byte).",
     has_one_unit, time_scaling},
};

}  // namespace

std::span<const Law> time_laws() { return time_list; }

}  // namespace stormproof::props
