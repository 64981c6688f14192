// Random deployments whose open-loop traffic is bounded, patient enough that nothing is repaired.
#pragma once

#include <algorithm>

#include "checker/engines/calculus/cannot_start.hpp"
#include "model/implementations.hpp"
#include "props/generators/dice.hpp"
#include "props/generators/space.hpp"

namespace stormproof::calculus {

/// Any implementation that engines know, any channel; small enough to run often.
inline model::Scenario covered_scenario(std::uint64_t seed) {
  props::ScenarioSpace space;
  space.max_participants = 6;
  space.max_endpoints = 12;
  space.losses = false;
  space.run_until = model::RunUntil::time_limit;
  props::Dice dice{seed ^ 0x5107'0000};
  space.implementation = dice.pick(model::known_to_engines());
  model::Scenario scenario = props::draw_scenario(seed, 100, space);
  model::SedpProfile& sedp = scenario.dds.sedp;
  sedp.heartbeat_policy = model::HeartbeatPolicy::periodic;
  if (!model::traits_of(scenario.dds).fixed_rules) {
    sedp.relation_opening = model::RelationOpening::receiver;
    sedp.initial_data = model::InitialData::push;
  }
  if (scenario.dds.spdp.resend == model::SpdpResend::none && dice.chance(80)) {
    scenario.dds.spdp.resend = model::SpdpResend::all_known;
  }
  const bool can_have_peers = scenario.dds.implementation == model::implementation_with_discovery;
  if (can_have_peers && dice.chance(30)) {
    scenario.dds.discovery = model::Discovery::static_peers;
    scenario.dds.peer_ports = static_cast<std::uint32_t>(dice.between(1, 6));
  }
  if (dice.chance(50)) sedp.piggyback = model::Piggyback::off;
  if (dice.chance(50)) scenario.wireless.fragment_request = model::FragmentRequest::at_admission;
  return scenario;
}

/// Timers that just allow for the longest delay of the deployment, where it has one. `suppresses`:
/// a stateful writer owes it to its suppression, not to the patience of its readers.
inline void be_patient(model::Scenario& scenario, bool suppresses) {
  model::SedpProfile& sedp = scenario.dds.sedp;
  const bool stateful = model::traits_of(scenario.dds).writer == model::Writer::stateful;
  if (stateful && suppresses) {
    for (model::Participant& p : scenario.deployment.participants) p.endpoints_done = p.start;
  }
  for (int round = 0; round < 3; ++round) {
    const Judged judged = judge(scenario);
    if (!judged.delay) return;
    const model::Nanoseconds delay = *judged.delay;
    sedp.initial_acknack_delay = std::max(sedp.initial_acknack_delay, delay);
    if (!stateful) {
      sedp.heartbeat_response_delay = delay;
    } else if (suppresses) {
      sedp.nack_suppression_duration =
          std::max(delay * 2, model::Nanoseconds{1}) - model::Nanoseconds{1};
    } else {
      sedp.heartbeat_response_delay = delay * 2 + sedp.nack_response_delay;
    }
  }
}

/// The same deployment with other start times: all at once, or spread over some airtimes.
inline void draw_starts(model::Scenario& scenario, std::uint64_t seed) {
  props::Dice dice{seed};
  const std::int64_t spread = dice.among({0, 0, 1'000, 1'000'000, 100'000'000});
  for (model::Participant& participant : scenario.deployment.participants) {
    const model::Nanoseconds creation = participant.endpoints_done - participant.start;
    participant.start = model::Nanoseconds{dice.between(0, spread)};
    participant.endpoints_done = participant.start + creation;
  }
}

}  // namespace stormproof::calculus
