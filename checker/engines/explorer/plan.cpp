// Delay bound, scopes and time bounds.
#include "checker/engines/explorer/plan.hpp"

#include <algorithm>

#include <fmt/core.h>

#include "checker/engines/bounds/completion_bound.hpp"
#include "model/fastdds/endpoints.hpp"
#include "model/implementations.hpp"
#include "model/packet_sizes.hpp"
#include "model/simulator.hpp"
#include "props/monitors/delay_meter.hpp"
#include "props/monitors/describe.hpp"
#include "props/monitors/monitors.hpp"

namespace stormproof::explorer {

using model::Nanoseconds;

namespace {

/// Whether the wireless profile gives every packet the same delay.
bool has_one_delay(const model::Scenario& scenario) {
  return props::takes_equal_times(scenario.wireless) && scenario.wireless.one_way.count() > 0;
}

constexpr unsigned default_publications = model::fastdds::default_publications;

/// DATA packets that the first descriptors of a stream need if they are sent at once to one reader.
std::uint32_t packets_of(const model::PacketSizes& sizes, model::Stream stream,
                         std::uint32_t count) {
  std::uint32_t packets = 0;
  std::int64_t payload = 0;
  for (std::uint32_t d = 0; d < count; ++d) {
    const std::int64_t bytes = sizes.descriptor(stream, d);
    if (packets == 0 || sizes.is_full(payload, bytes)) {
      ++packets;
      payload = sizes.header + sizes.destination;
    }
    payload += bytes;
  }
  return packets;
}

Scope scope_of(const model::Scenario& scenario, Nanoseconds delay, unsigned descriptors,
               unsigned losses) {
  Scope scope;
  scope.descriptors = descriptors;
  scope.losses = losses;
  scope.least_delay = Nanoseconds{1};  // nothing arrives at the instant of its emission
  scope.largest_delay = delay;
  scope.leaves_within = delay;
  if (has_one_delay(scenario)) {
    scope.least_delay = delay;
    scope.leaves_within = Nanoseconds{0};
  }
  // Where nothing waits for it, nothing depends on it.
  if (!model::traits_of(scenario.dds).waits_for_source) scope.leaves_within = Nanoseconds{0};
  scope.side_by_side = scenario.dds.sedp.relation_opening == model::RelationOpening::each_side;
  return scope;
}

/// The first HEARTBEATs follow each other at this distance.
Nanoseconds heartbeat_distance(const model::Scenario& scenario) {
  const model::SedpProfile& sedp = scenario.dds.sedp;
  return props::has_samples(scenario) ? sedp.heartbeat_interval : sedp.heartbeat_period;
}

}  // namespace

DelayBound delay_bound(const model::Scenario& scenario, const std::function<bool()>& go_on) {
  if (has_one_delay(scenario)) {
    return {scenario.wireless.one_way, fmt::format("Every packet takes {}, as the profile says.",
                                                   props::time_text(scenario.wireless.one_way))};
  }
  constexpr std::uint64_t most_events = 20'000'000;
  model::RunOptions options;
  options.max_events = most_events;
  options.on_progress = [&](const model::Progress&) { return go_on(); };
  const model::RunResult result = model::simulate(scenario, options);
  Nanoseconds measured;
  for (const model::TrafficClass traffic :
       {model::TrafficClass::initial_data, model::TrafficClass::repair_data,
        model::TrafficClass::heartbeat, model::TrafficClass::acknack}) {
    measured = std::max(measured, result.latency[static_cast<std::size_t>(traffic)].longest);
  }
  const Nanoseconds quarter{std::max<std::int64_t>(1, heartbeat_distance(scenario).count() / 4)};
  if (measured.count() > 0 && measured <= quarter) {
    return {measured, fmt::format("Every packet takes at most {}, the largest delay in the "
                                  "scenario's run.",
                                  props::time_text(measured))};
  }
  if (measured.count() == 0) {
    return {quarter, fmt::format("Every packet takes at most {}, a quarter of the HEARTBEAT "
                                 "period; the scenario's run has no discovery packet.",
                                 props::time_text(quarter))};
  }
  return {quarter,
          fmt::format("Every packet takes at most {}, a quarter of the HEARTBEAT period; in the "
                      "scenario's run packets take up to {}.",
                      props::time_text(quarter), props::time_text(measured))};
}

Nanoseconds creation_distance(const model::Scenario& scenario) {
  const std::int64_t suppression = scenario.dds.sedp.nack_suppression_duration.count();
  return Nanoseconds{std::max<std::int64_t>(1, suppression / 2)};
}

Splitting splitting(const model::Scenario& scenario) {
  const model::PacketSizes sizes = model::packet_sizes(scenario.dds);
  const model::DescriptorProfile& defaults = scenario.dds.descriptors;
  std::uint32_t publications = 0;
  std::uint32_t subscriptions = 0;
  for (const model::Participant& participant : scenario.deployment.participants) {
    publications = std::max(publications, participant.publications);
    subscriptions = std::max(subscriptions, participant.subscriptions);
  }
  Splitting splitting;
  splitting.in_scenario = std::max(
      packets_of(sizes, model::Stream::pub, defaults.default_publications + publications),
      packets_of(sizes, model::Stream::sub, defaults.default_subscriptions + subscriptions));
  model::DdsProfile explored = scenario.dds;
  unsigned least = default_publications;
  unsigned most = default_publications;
  if (!creates_over_time(scenario)) {
    explored.descriptors.default_publications = 0;
    least = 2;
    most = most_descriptors;
  }
  for (unsigned count = least; count <= most && !splitting.descriptors; ++count) {
    const bool splits = packets_of(model::packet_sizes(explored), model::Stream::pub, count) > 1;
    if (splits) splitting.descriptors = count;
  }
  return splitting;
}

std::optional<std::uint32_t> generated_before_heartbeat(const model::Scenario& scenario) {
  const model::SedpProfile& sedp = scenario.dds.sedp;
  if (sedp.piggyback == model::Piggyback::off || creates_over_time(scenario)) return std::nullopt;
  constexpr std::uint32_t enough = 10'000;
  const std::int64_t bytes = scenario.dds.descriptors.user_bytes.count();
  const bool cumulative = sedp.piggyback == model::Piggyback::cumulative;
  // As if each were alone in its packet, and nothing filled the budget again.
  std::int64_t budget = sedp.piggyback_threshold_bytes.count();
  std::uint32_t count = 0;
  for (; count < enough; ++count) {
    budget -= cumulative ? bytes * (count + 1) : bytes;
    if (budget < 0) break;
  }
  return count;
}

bool creates_over_time(const model::Scenario& scenario) {
  return model::traits_of(scenario.dds).creates_endpoints_over_time;
}

std::vector<Scope> scopes(const model::Scenario& scenario, Nanoseconds delay) {
  std::vector<Scope> list;
  const auto add = [&](unsigned descriptors, unsigned losses, unsigned pushed) {
    list.push_back(scope_of(scenario, delay, descriptors, losses));
    list.back().pushed = pushed;
  };
  if (props::has_samples(scenario)) {
    for (const unsigned losses : {0U, 1U, 2U}) add(most_samples, losses, 0);
    add(1, 0, 1);
    add(1, 1, 1);
    add(most_samples, 0, 1);
    for (Scope& scope : list) scope.side_by_side = true;
    return list;
  }
  if (creates_over_time(scenario)) {
    add(default_publications, 0, 0);
    add(default_publications, 0, 1);
    add(default_publications, 0, 2);
    add(default_publications, 1, 0);
    add(default_publications, 1, 1);
    list.push_back(list.front());
    list.back().side_by_side = true;
    return list;
  }
  const Splitting split = splitting(scenario);
  const bool splits = split.in_scenario > 1 && split.descriptors;
  add(1, 0, 0);
  if (splits) add(*split.descriptors, 0, 0);
  add(1, 1, 0);
  add(1, 2, 0);
  // Two that share a packet where the scenario's relations fit into one.
  if (splits || split.descriptors != 2) add(splits ? *split.descriptors : 2, 1, 0);
  return list;
}

// With delays of their own for all packets of two relations there are too many interleavings to try
// all of them; with one delay for all there are few, and several losses are possible.
std::vector<Scope> shared_scopes(const model::Scenario& scenario, Nanoseconds delay,
                                 unsigned readers, unsigned writers) {
  const bool created = creates_over_time(scenario);
  std::vector<Scope> list;
  const auto add = [&](unsigned losses, bool one_delay) -> Scope& {
    Scope& scope =
        list.emplace_back(scope_of(scenario, delay, created ? default_publications : 1, losses));
    scope.readers = readers;
    scope.writers = writers;
    if (one_delay) {
      scope.least_delay = delay;
      scope.leaves_within = Nanoseconds{0};
    }
    return scope;
  };
  add(2, true);
  if (readers > 1 && !list.front().side_by_side) add(1, true).joins_within = delay;
  if (readers > 1 && created) add(1, true).pushed = 1;
  if (!has_one_delay(scenario)) add(0, false);
  return list;
}

std::optional<Nanoseconds> completion_bound(const model::DdsProfile& dds, const Scope& scope) {
  // The bound counts from the opening of the relation, or the creation of a descriptor; the
  // explorer from the start of its world.
  const bool apart = model::traits_of(dds).writer == model::Writer::of_the_paper &&
                     dds.sedp.relation_opening == model::RelationOpening::each_side;
  if (apart || scope.side_by_side || scope.pushed > 0) return std::nullopt;
  timeline::Circumstances circumstances;
  circumstances.delta = scope.largest_delay;
  circumstances.source = scope.leaves_within;
  circumstances.timer_starts_with_relation = scope.readers == 1;
  circumstances.least = scope.least_delay;
  const auto bound = timeline::completion_bound(dds, circumstances);
  return bound ? bound->after(scope.losses) : std::nullopt;
}

}  // namespace stormproof::explorer
