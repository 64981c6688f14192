// Delay bound, scopes and time bounds.
#include "checker/engines/explorer/plan.hpp"

#include <algorithm>

#include <fmt/core.h>

#include "checker/engines/bounds/completion_bound.hpp"
#include "model/descriptor_sizes.hpp"
#include "model/implementations.hpp"
#include "model/simulator.hpp"
#include "props/monitors/describe.hpp"

namespace stormproof::explorer {

using model::Nanoseconds;

namespace {

/// Whether the wireless profile gives every packet the same delay.
bool has_one_delay(const model::Scenario& scenario) {
  return scenario.wireless.kind == model::ServiceKind::constant_delay &&
         scenario.wireless.packet_delays.empty() && scenario.wireless.one_way.count() > 0;
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
  const Nanoseconds quarter{
      std::max<std::int64_t>(1, scenario.dds.sedp.heartbeat_period.count() / 4)};
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

bool splits_packets(const model::Scenario& scenario) {
  const std::int64_t bytes = scenario.dds.descriptors.user_bytes.count();
  return packet_is_full(scenario.dds.sedp, bytes,
                        bytes - scenario.dds.sedp.shared_header_bytes.count());
}

bool creates_over_time(const model::Scenario& scenario) {
  return model::traits_of(scenario.dds).creates_endpoints_over_time;
}

std::vector<Scope> scopes(const model::Scenario& scenario, Nanoseconds delay) {
  std::vector<Scope> list;
  const auto add = [&](unsigned descriptors, unsigned losses, unsigned pushed) {
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
    scope.pushed = pushed;
    scope.side_by_side = scenario.dds.sedp.relation_opening == model::RelationOpening::each_side;
    list.push_back(scope);
  };
  if (creates_over_time(scenario)) {
    constexpr unsigned all = 9;  // the publications of a default participant
    add(all, 0, 0);
    add(all, 0, 1);
    add(all, 0, 2);
    add(all, 1, 0);
    add(all, 1, 1);
    for (Scope& scope : list) scope.leaves_within = Nanoseconds{0};  // nothing depends on it
    list.push_back(list.front());
    list.back().side_by_side = true;
    return list;
  }
  add(1, 0, 0);
  if (splits_packets(scenario)) add(2, 0, 0);
  add(1, 1, 0);
  add(1, 2, 0);
  add(2, 1, 0);
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
  circumstances.timer_starts_with_relation = true;  // it is the writer's only relation
  circumstances.least = scope.least_delay;
  const auto bound = timeline::completion_bound(dds, circumstances);
  return bound ? bound->after(scope.losses) : std::nullopt;
}

}  // namespace stormproof::explorer
