// A profile with delays of a few nanoseconds, small enough to enumerate every run.
#pragma once

#include "model/scenario.hpp"

namespace stormproof::explorer {

inline model::Scenario tiny_scenario() {
  using model::Nanoseconds;
  model::Scenario scenario;
  scenario.deployment = model::Deployment::homogeneous(2, 1, 2);
  scenario.wireless.kind = model::ServiceKind::constant_delay;
  scenario.wireless.one_way = Nanoseconds{1};
  model::SedpProfile& sedp = scenario.dds.sedp;
  sedp.heartbeat_period = Nanoseconds{9};
  sedp.heartbeat_response_delay = Nanoseconds{1};
  sedp.nack_response_delay = Nanoseconds{2};
  sedp.nack_suppression_duration = Nanoseconds{2};
  sedp.initial_acknack_delay = Nanoseconds{0};
  sedp.piggyback = model::Piggyback::off;
  scenario.time_limit = Nanoseconds{200};
  return scenario;
}

}  // namespace stormproof::explorer
