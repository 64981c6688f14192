// The scenario for packets and rules that a test hands to `implementation: fastdds` itself.
#pragma once

#include "model/scenario.hpp"

namespace stormproof::model::fastdds {

/// Participant 0 has all its endpoints at its start and is alone on its host; the other one creates
/// its own so late that nothing of it is seen. A constant delay, no piggybacked HEARTBEATs, no SPDP
/// replies.
inline Scenario one_writer() {
  Scenario scenario;
  scenario.deployment = Deployment::homogeneous(2, 1, 0);
  scenario.deployment.participants[1].endpoints_done = Nanoseconds{1'700'000'000'000'000};
  scenario.dds.implementation = ImplementationKind::fastdds;
  scenario.dds.spdp.resend = SpdpResend::none;
  scenario.dds.sedp.piggyback = Piggyback::off;
  scenario.wireless.kind = ServiceKind::constant_delay;
  scenario.wireless.one_way = Nanoseconds{1'000'000};
  return scenario;
}

}  // namespace stormproof::model::fastdds
