// B = L + E + I + R + C, with
//   L the longest lease: after it no side remembers one that has forgotten it;
//   E until whoever starts has created its endpoints, where that takes time;
//   I until the next initial ACKNACK. Where distances double, the next one comes at most as long
//     after the last failure as that was after the start, and 2 τ_I more;
//   R until a reader asks again by itself, and may;
//   C the bound of live.completion with one loss, which stands for what the last failure has left
//     half done. It contains the period of announcements, for each of its attempts.
// Of Cyclone DDS, of which no theorem says anything, B = L + E + A + k (H + N + 4 Δ), a margin:
//   A until the next announcement, to addresses that age, too;
//   H the longest distance of HEARTBEATs, N until a reader that was told that it lacks something
//     may ask, and asks again by itself;
//   k rounds: one to hear of what there is, one to ask for it, and one more for each queue of
//     repairs that fills up with what a participant sends to all others.
// With Discovery Servers, of which no theorem says anything either, B = 2 L + E + P + 2 T + k (R +
// H + N + 4 Δ), a margin:
//   2 L: that somebody is gone waits for those who are behind the same outage, until their leases
//     are over, too;
//   P until the next announcement, T a client's tick, R the server's routine;
//   k rounds, as above, in each of which a HEARTBEAT is lost or asked for.
#include "props/monitors/recovery_bound.hpp"

#include <algorithm>

#include "model/amendments.hpp"
#include "model/cyclone/life_periods.hpp"
#include "model/engine/node_endpoints.hpp"
#include "model/implementations.hpp"
#include "props/monitors/completion.hpp"

namespace stormproof::props {

using model::Nanoseconds;

namespace {

/// `usual`: of those for whom nothing is said.
Nanoseconds longest_lease(const model::Deployment& deployment, Nanoseconds usual = {}) {
  if (!deployment.life) return {};
  Nanoseconds longest = deployment.life->lease.value_or(usual);
  for (const model::Lease& lease : deployment.life->leases) {
    longest = std::max(longest, lease.duration);
  }
  return longest;
}

Nanoseconds longest_creation(const model::Scenario& scenario) {
  Nanoseconds longest;
  if (!model::traits_of(scenario.dds).creates_endpoints_over_time) return longest;
  for (const model::Participant& participant : scenario.deployment.participants) {
    longest = std::max(longest, participant.endpoints_done - participant.start);
  }
  return longest;
}

Nanoseconds until_initial_acknack(const model::SedpProfile& sedp, const model::Amendments& rules,
                                  Nanoseconds failed) {
  const Nanoseconds first = sedp.initial_acknack_delay;
  if (first.count() == 0) return {};
  using enum model::InitialAckNackRepeat;
  switch (rules.initial_acknack_repeat) {
    case once:
      return first;
    case age_based:
    case age_based_zero:
      return std::max(first, Nanoseconds{1'000'000'000});
    case again:
      break;
  }
  const bool doubling = sedp.initial_acknack_interval == model::InitialAckNackInterval::doubling;
  return doubling ? failed + first * 2 : first;
}

Nanoseconds until_asked_again(const model::Amendments& rules) {
  if (rules.reader_retry == model::ReaderRetry::off) return rules.reader_nack_delay;
  return rules.reader_nack_delay + rules.reader_retry_period;
}

Nanoseconds until_announced(const model::Scenario& scenario) {
  const model::DdsProfile& dds = scenario.dds;
  const Nanoseconds usual = model::lease_of(dds);
  Nanoseconds longest = model::cyclone::announcing_period(dds, usual);
  if (scenario.deployment.life) {
    for (const model::Lease& lease : scenario.deployment.life->leases) {
      longest = std::max(longest, model::cyclone::announcing_period(dds, lease.duration));
    }
  }
  if (!model::cyclone::prunes(dds) || dds.allow_multicast == model::AllowMulticast::always) {
    return longest;
  }
  return std::max(longest,
                  model::cyclone::said_interval(dds).value_or(model::cyclone::usual_interval));
}

std::int64_t rounds(const model::Scenario& scenario) {
  std::int64_t most = 0;
  for (const model::Participant& one : scenario.deployment.participants) {
    const std::int64_t endpoints = std::int64_t{one.publications} + one.subscriptions +
                                   model::default_publications + model::default_subscriptions;
    most = std::max(most, endpoints);
  }
  const std::int64_t copies = most * scenario.deployment.size();
  return 2 + copies / std::max(1U, scenario.dds.sedp.max_queued_rexmit_messages);
}

Nanoseconds recovery_bound_of_cyclone(const model::Scenario& scenario, Nanoseconds delay) {
  const model::SedpProfile& sedp = scenario.dds.sedp;
  const Nanoseconds of_round = sedp.heartbeat_interval_max + sedp.ack_delay + sedp.nack_delay +
                               sedp.auto_resched_nack_delay + delay * 4;
  return longest_lease(scenario.deployment, model::lease_of(scenario.dds)) +
         longest_creation(scenario) + until_announced(scenario) + of_round * rounds(scenario);
}

Nanoseconds recovery_bound_with_server(const model::Scenario& scenario, Nanoseconds delay) {
  const model::DdsProfile& dds = scenario.dds;
  constexpr std::int64_t rounds_of_relays = 4;
  const Nanoseconds of_round = dds.server.server_routine_period + dds.sedp.heartbeat_period +
                               dds.sedp.nack_response_delay + dds.sedp.heartbeat_response_delay +
                               delay * 4;
  return longest_lease(scenario.deployment, model::lease_of(dds)) * 2 + longest_creation(scenario) +
         dds.spdp.period + dds.server.client_sync_period * 2 + of_round * rounds_of_relays;
}

}  // namespace

Nanoseconds recovery_bound(const model::Scenario& scenario, Nanoseconds failed, Nanoseconds delay) {
  if (model::traits_of(scenario.dds).has_event_thread) {
    return recovery_bound_of_cyclone(scenario, delay);
  }
  if (model::traits_of(scenario.dds).has_server) return recovery_bound_with_server(scenario, delay);
  const model::DdsProfile& dds = scenario.dds;
  const model::Amendments rules = dds.amendments.value_or(model::Amendments{});
  return longest_lease(scenario.deployment) + longest_creation(scenario) +
         until_initial_acknack(dds.sedp, rules, failed) + until_asked_again(rules) +
         completion_bound(dds, delay, 1);
}

}  // namespace stormproof::props
