// Lookups in the lists of a deployment.
#include "tests/oracle/oracle_lives.hpp"

#include <algorithm>

namespace stormproof::oracle {

namespace {
model::Life life_of(const model::Scenario& scenario) {
  return scenario.deployment.life.value_or(model::Life{});
}
/// That of who has no other one.
std::int64_t common_lease(const model::Scenario& scenario) {
  constexpr std::int64_t fast_dds = 20'000'000'000;
  const model::Life life = life_of(scenario);
  if (life.lease) return life.lease->count();
  const bool is_fast_dds = scenario.dds.implementation == model::ImplementationKind::fastdds;
  if (!is_fast_dds || life == model::Life{}) return 0;
  return scenario.dds.spdp.lease ? scenario.dds.spdp.lease->count() : fast_dds;
}
}  // namespace

std::int64_t lease_of(const model::Scenario& scenario, std::uint32_t i) {
  const model::Life life = life_of(scenario);
  for (const model::Lease& lease : life.leases) {
    if (lease.participant == i) return lease.duration.count();
  }
  return common_lease(scenario);
}

bool dies(const model::Scenario& scenario, std::uint32_t i) {
  if (scenario.dds.implementation != model::ImplementationKind::fastdds) return false;
  for (const model::Mute& mute : life_of(scenario).mute) {
    if (mute.participant == i) return true;
  }
  return is_replaced(scenario, i);
}

bool is_replaced(const model::Scenario& scenario, std::uint32_t i) {
  for (const model::Restart& restart : life_of(scenario).restarts) {
    if (restart.participant == i && restart.identity == model::Identity::fresh) return true;
  }
  return false;
}

bool is_away(const model::Scenario& scenario, std::uint32_t i, std::int64_t at) {
  const model::Life life = life_of(scenario);
  for (const model::Mute& mute : life.mute) {
    if (mute.participant == i && at >= mute.from.count()) return true;
  }
  for (const model::Restart& back : life.restarts) {
    if (back.participant != i || at < back.stop.count()) continue;
    if (back.identity == model::Identity::fresh || at < back.start.count()) return true;
  }
  return false;
}

bool is_ready(const model::Scenario& scenario, std::uint32_t i, std::int64_t at) {
  const std::optional<model::Nanoseconds> ready = scenario.deployment.participants[i].ready;
  return !ready || at >= ready->count();
}

bool is_cut_off(const model::Scenario& scenario, std::uint32_t from, std::uint32_t to,
                std::int64_t at) {
  for (const model::Outage& outage : life_of(scenario).outages) {
    const bool is_on = at >= outage.start.count() && at < outage.end.count();
    if (outage.from == from && outage.to == to && is_on) return true;
  }
  return false;
}

std::int64_t settled(const model::Scenario& scenario) {
  const model::Life life = life_of(scenario);
  std::int64_t longest = common_lease(scenario);
  std::int64_t last = 0;
  for (const model::Lease& lease : life.leases) longest = std::max(longest, lease.duration.count());
  for (const model::Participant& p : scenario.deployment.participants) {
    last = std::max(last, p.start.count());
  }
  for (const model::Outage& outage : life.outages) last = std::max(last, outage.end.count());
  for (const model::Mute& mute : life.mute) last = std::max(last, mute.from.count());
  for (const model::Restart& back : life.restarts) last = std::max(last, back.start.count());
  for (const model::LateEndpoints& late : life.endpoints) {
    last = std::max(last, late.until.value_or(late.at).count());
  }
  const bool forgets = longest > 0 || !life.restarts.empty();
  return forgets ? last + longest : 0;
}

}  // namespace stormproof::oracle
