// Laws of time limits that need no run: discovery cannot be faster than physics, and not slower
// than the rounds of HEARTBEAT, ACKNACK and repair allow.
//
// The physical bound. When discovery is complete, every relation (i,j,s) with descriptors has had
// at least one DATA packet, which was served in every stage, and these packets carried each of its
// descriptors. So a channel served, for each such relation and each of its stages, at least one
// fragment with overhead O, and at least B bytes at rate R, where B are the link, IP, UDP and
// message headers once and what each descriptor adds. f fragments of B bytes together take at least
// f·O + 8·10⁹·B/R − f/2 ns (each is rounded by at most half a nanosecond), which for O ≥ 1 is least
// for f = 1. A stage without overhead is left out: there rounding may make airtimes zero. Nothing
// is served before the first participant starts, so T_disc is at least that start and the largest
// of these sums over all channels. With a constant delay: every participant with descriptors has
// started, and its DATA takes its delay. A client of a Discovery Server says nothing about its
// endpoints before its first tick, and what it says goes two ways, to the server and from there.
#include <algorithm>
#include <map>

#include <fmt/core.h>

#include "model/airtime.hpp"
#include "model/engine/topology.hpp"
#include "model/fastdds/endpoints.hpp"
#include "model/packet_sizes.hpp"
#include "props/laws/families.hpp"
#include "props/laws/run_log.hpp"
#include "props/monitors/completion.hpp"
#include "props/monitors/delay_probe.hpp"
#include "props/monitors/describe.hpp"

namespace stormproof::props {

namespace {

using model::Nanoseconds;
using model::Scenario;
using model::Stream;
using Broken = std::optional<std::string>;

/// Least bytes on the channel for the descriptors of one stream.
std::int64_t least_bytes(const Scenario& scenario, Stream stream, std::uint32_t count) {
  const model::PacketSizes sizes = model::packet_sizes(model::fastdds::deployed_profile(scenario));
  std::int64_t sum = sizes.header + model::udp_header_bytes + model::ip_header_bytes +
                     scenario.wireless.link_overhead_bytes.count();
  for (std::uint32_t d = 0; d < count; ++d) sum += sizes.descriptor(stream, d);
  return sum;
}

/// The largest sum of first-transmission airtime of a channel, as explained above.
Nanoseconds least_airtime(const Scenario& scenario, const model::Topology& topology) {
  std::map<std::string_view, std::int64_t> channels;
  for (std::uint32_t i = 0; i < topology.participant_count(); ++i) {
    for (const Stream s : model::streams) {
      const std::uint32_t count = topology.descriptor_count(i, s);
      if (count == 0) continue;
      const std::int64_t bytes = least_bytes(scenario, s, count);
      for (const model::Stage& stage : scenario.wireless.stages) {
        const model::ServiceRate rate = service_rate(scenario.wireless, stage, false);
        if (rate.overhead_ns == 0) continue;
        const std::int64_t airtime =
            rate.overhead_ns + 8 * bytes * 1'000'000'000 / rate.bits_per_second - 1;
        channels[stage.channel] += topology.peer_count(i) * airtime;
      }
    }
  }
  std::int64_t busiest = 0;
  for (const auto& [name, sum] : channels) busiest = std::max(busiest, sum);
  return Nanoseconds{busiest};
}

/// `delay`: the least of one way that is not the loopback.
Nanoseconds floor_with_server(const Scenario& scenario, Nanoseconds delay) {
  Nanoseconds last_start;
  for (const model::Participant& p : scenario.deployment.participants) {
    last_start = std::max(last_start, p.start);
  }
  return last_start + scenario.dds.server.client_sync_period +
         std::min(delay, scenario.deployment.loopback_delay) * 2;
}

Nanoseconds physical_bound(const Scenario& scenario) {
  const model::Topology topology{scenario.deployment, scenario.dds.descriptors};
  const model::WirelessProfile& wireless = scenario.wireless;
  Nanoseconds first = scenario.deployment.participants.front().start;
  Nanoseconds last_arrival;
  Nanoseconds delay;
  if (wireless.kind == model::ServiceKind::constant_delay) {
    delay = wireless.one_way;
    for (const auto& own : wireless.packet_delays) delay = std::min(delay, own.one_way);
  }
  for (std::uint32_t i = 0; i < topology.participant_count(); ++i) {
    first = std::min(first, topology.start(i));
    const bool sends =
        topology.peer_count(i) > 0 &&
        topology.descriptor_count(i, Stream::pub) + topology.descriptor_count(i, Stream::sub) > 0;
    if (!sends) continue;
    const Nanoseconds ready = traits_of(scenario).creates_endpoints_over_time
                                  ? scenario.deployment.participants[i].endpoints_done
                                  : topology.start(i);
    last_arrival = std::max(last_arrival, ready + delay);
  }
  if (traits_of(scenario).has_server) {
    last_arrival = std::max(last_arrival, floor_with_server(scenario, delay));
  }
  if (wireless.kind == model::ServiceKind::constant_delay) return last_arrival;
  return std::max(last_arrival, first + least_airtime(scenario, topology));
}

Broken physical(const Scenario& scenario, const Simulate& simulate) {
  const model::RunResult result = simulate(scenario, nullptr);
  const Nanoseconds bound = physical_bound(scenario);
  if (!result.completed() || *result.discovery_time >= bound) return std::nullopt;
  return fmt::format("Discovery takes {}, but its first transmissions alone need {}.",
                     time_text(*result.discovery_time), time_text(bound));
}

Broken completion(const Scenario& scenario, const Simulate& simulate) {
  DelayProbe probe{scenario};
  const model::RunResult result = simulate(scenario, &probe);
  if (was_cut_off(result)) return std::nullopt;
  Nanoseconds ready;
  for (const model::Participant& p : scenario.deployment.participants) {
    ready = std::max(ready,
                     traits_of(scenario).creates_endpoints_over_time ? p.endpoints_done : p.start);
  }
  const Nanoseconds known =
      result.end == model::RunEnd::completed ? *result.discovery_time : scenario.time_limit;
  const Nanoseconds largest = probe.delays().largest(known);
  const Nanoseconds bound = ready + completion_bound(scenario.dds, largest, probe.delays().lost());
  const Nanoseconds took = result.completed() ? *result.discovery_time : known;
  if (took <= bound) return std::nullopt;
  return fmt::format(
      "With packets that take at most {} and {} lost, discovery {} {}; it has to be "
      "complete at {}.",
      time_text(largest), probe.delays().lost(),
      result.completed() ? "is complete at" : "is not complete at", time_text(took),
      time_text(bound));
}

constexpr Law bounds_list[] = {
    {"law.physical-bound",
     "T_disc is at least the first start and, on every channel, the airtime of one DATA packet "
     "with all descriptors for each relation; with a Discovery Server, the last start and a tick.",
     is_sent_to_each, physical},
    {"law.completion-bound",
     "If no packet takes longer than Δ and k are lost, discovery is complete within "
     "completion_bound(Δ, k) after everybody is there.",
     is_of_two_writers, completion},
};

}  // namespace

std::span<const Law> bound_laws() { return bounds_list; }

}  // namespace stormproof::props
