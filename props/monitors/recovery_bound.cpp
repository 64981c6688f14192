// B = L + E + I + R + C, with
//   L the longest lease: after it no side remembers one that has forgotten it;
//   E until whoever starts has created its endpoints, where that takes time;
//   I until the next initial ACKNACK. Where distances double, the next one comes at most as long
//     after the last failure as that was after the start, and 2 τ_I more;
//   R until a reader asks again by itself, and may;
//   C the bound of live.completion with one loss, which stands for what the last failure has left
//     half done. It contains the period of announcements, for each of its attempts.
#include "props/monitors/recovery_bound.hpp"

#include <algorithm>

#include "model/amendments.hpp"
#include "model/implementations.hpp"
#include "props/monitors/completion.hpp"

namespace stormproof::props {

using model::Nanoseconds;

namespace {

Nanoseconds longest_lease(const model::Deployment& deployment) {
  if (!deployment.life) return {};
  Nanoseconds longest = deployment.life->lease.value_or(Nanoseconds{});
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

}  // namespace

Nanoseconds recovery_bound(const model::Scenario& scenario, Nanoseconds failed, Nanoseconds delay) {
  const model::DdsProfile& dds = scenario.dds;
  const model::Amendments rules = dds.amendments.value_or(model::Amendments{});
  return longest_lease(scenario.deployment) + longest_creation(scenario) +
         until_initial_acknack(dds.sedp, rules, failed) + until_asked_again(rules) +
         completion_bound(dds, delay, 1);
}

}  // namespace stormproof::props
