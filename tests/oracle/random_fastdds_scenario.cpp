// The generator of random scenarios of `implementation: fastdds`. As in the generator for the
// paper's model, sizes and the wireless profile come first and give the time scale, which periods,
// schedules and the time limit follow.
#include "tests/oracle/random_fastdds_scenario.hpp"

#include <algorithm>

#include "tests/oracle/random_dice.hpp"
#include "tests/oracle/random_parts.hpp"

namespace stormproof::oracle {

namespace {

using model::Bytes;
using model::Nanoseconds;
using model::Scenario;

constexpr std::int64_t us = 1'000;
constexpr std::int64_t ms = 1'000'000;
constexpr std::int64_t s = 1'000'000'000;
constexpr std::int64_t default_endpoints = 17;

// A message takes about 160 descriptors; a few scenarios have more than that to send at once.
constexpr std::uint32_t full_message = 160;

std::uint32_t random_endpoints(Dice& dice) {
  return dice.pick<std::uint32_t>({0, dice.count(1, 3), dice.count(0, 12)});
}

void fill_deployment(Dice& dice, Scenario& scenario) {
  const std::uint32_t hosts = dice.count(2, 3);
  const bool large = dice.chance(4);
  const std::uint32_t size = dice.count(2, large ? 3 : 6);
  const bool busy = dice.chance(70);
  for (std::uint32_t i = 0; i < size; ++i) {
    model::Participant p;
    p.host.value = dice.count(0, hosts - 1);
    if (busy) p.publications = random_endpoints(dice);
    if (busy) p.subscriptions = random_endpoints(dice);
    scenario.deployment.participants.push_back(p);
  }
  if (large) scenario.deployment.participants.front().publications = dice.count(full_message, 400);
  if (!scenario.deployment.has_cross_host_pair()) {
    std::uint32_t& host = scenario.deployment.participants.back().host.value;
    host = host == 0 ? 1 : 0;
  }
}

// A threshold between one byte, which adds a HEARTBEAT to every DATA, and one that no run reaches.
void fill_piggyback(Dice& dice, model::SedpProfile& sedp) {
  using model::Piggyback;
  sedp.piggyback = dice.pick<Piggyback>({Piggyback::cumulative, Piggyback::cumulative,
                                         Piggyback::cumulative, Piggyback::linear, Piggyback::off});
  sedp.piggyback_threshold_bytes = Bytes{dice.pick<std::int64_t>(
      {106'496, 106'496, 1, dice.between(300, 1'500), dice.between(1'000, 20'000), 4'000'000,
       dice.magnitude(1, 100'000)})};
}

void fill_protocol(Dice& dice, model::DdsProfile& dds) {
  using Resend = model::SpdpResend;
  dds.implementation = model::ImplementationKind::fastdds;
  dds.spdp.resend = dice.pick<Resend>({Resend::all_known, Resend::all_known,
                                       Resend::new_and_multicast, Resend::new_only, Resend::none});
  if (dice.chance(30)) dds.sedp.heartbeat_policy = model::HeartbeatPolicy::adaptive;
  fill_piggyback(dice, dds.sedp);
}

void fill_timers(Dice& dice, const Clock& clock, model::DdsProfile& dds) {
  dds.spdp.period = period(dice, clock);
  dds.spdp.startup_period = period(dice, clock);
  dds.spdp.startup_announcements = dice.pick<std::uint32_t>({5, 5, 0, 1, 2});
  dds.sedp.heartbeat_period = period(dice, clock);
  dds.sedp.heartbeat_response_delay = reaction(dice, clock, 10 * us);
  dds.sedp.nack_response_delay = reaction(dice, clock, 100 * us);
  dds.sedp.nack_suppression_duration = reaction(dice, clock, 10 * us);
  dds.sedp.initial_acknack_delay = reaction(dice, clock, clock.scale / 4);
  model::AdaptiveProfile& adaptive = dds.sedp.adaptive;
  adaptive.min_period = period(dice, clock);
  adaptive.max_period = adaptive.min_period * dice.pick<std::int64_t>({1, 2, 10, 100});
  adaptive.epsilon_numerator = dice.pick<std::int64_t>({1, 1, 1, 2, 3});
  adaptive.epsilon_denominator = dice.pick<std::int64_t>({20, 20, 3, 4, 7, 1'000});
}

// The loopback delay may be that of the constant-delay channel, so that receptions over both meet.
void fill_loopback(Dice& dice, const Clock& clock, Scenario& scenario) {
  const std::int64_t one_way = scenario.wireless.one_way.count();
  const auto other =
      dice.pick<std::int64_t>({0, one_way, 1, 60 * us, 2 * ms, 2 * ms, dice.magnitude(1, 1 * s)});
  const std::int64_t steps = clock.grid * dice.between(0, 3);
  scenario.deployment.loopback_delay = Nanoseconds{clock.lockstep ? steps : other};
}

// How long a participant takes to create its endpoints: nothing, one step for each, or any time.
std::int64_t random_creation(Dice& dice, const Clock& clock, const model::Participant& p) {
  if (p.publications >= full_message && dice.chance(70)) return 0;
  const std::int64_t count = default_endpoints + p.publications + p.subscriptions;
  const std::int64_t step = clock.grid * dice.between(1, 2);
  if (clock.lockstep) return count * step * dice.between(0, 1);
  const std::int64_t in_steps = std::min(count * step, clock.scale);
  return dice.pick<std::int64_t>({0, in_steps, clock.scale / 4, clock.scale,
                                  dice.between(0, clock.scale), dice.magnitude(1, clock.scale)});
}

void fill_schedule(Dice& dice, const Clock& clock, Scenario& scenario) {
  const std::vector<std::int64_t> starts{0, 0, clock.on_grid(clock.scale / 4),
                                         clock.on_grid(dice.magnitude(1, clock.scale)),
                                         clock.on_grid(clock.scale)};
  const bool together = dice.chance(30);
  const bool alike = dice.chance(30);
  const std::int64_t common = random_creation(dice, clock, {});
  std::int64_t latest = 0;
  for (model::Participant& p : scenario.deployment.participants) {
    if (!together) p.start = Nanoseconds{dice.pick(starts)};
    const std::int64_t creation = alike ? common : random_creation(dice, clock, p);
    p.endpoints_done = p.start + Nanoseconds{creation};
    latest = std::max(latest, p.endpoints_done.count());
  }
  const std::int64_t limit = latest + clock.scale * dice.pick<std::int64_t>({1, 2, 4, 8, 16});
  scenario.time_limit = Nanoseconds{std::clamp(limit, 1 * ms, 20 * s)};
}

}  // namespace

Scenario random_fastdds_scenario(std::uint64_t seed) {
  Dice dice{seed};
  Scenario scenario;
  fill_deployment(dice, scenario);
  fill_wireless(dice, scenario.wireless);
  fill_protocol(dice, scenario.dds);
  const Clock clock = make_clock(dice, scenario);
  fill_timers(dice, clock, scenario.dds);
  fill_loopback(dice, clock, scenario);
  fill_schedule(dice, clock, scenario);
  return scenario;
}

}  // namespace stormproof::oracle
