// The generator of random scenarios. Sizes and the wireless profile come first; the open-loop
// airtime then gives the time scale of the scenario, and periods, starts and the time limit follow
// from that, so that neither all runs complete nor none, whatever the rates are.
#include "tests/oracle/random_scenario.hpp"

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

std::uint32_t random_endpoints(Dice& dice) {
  switch (dice.between(0, 3)) {
    case 0:
      return 0;
    case 1:
      return dice.count(1, 3);
    default:
      return dice.count(0, 20);
  }
}

void fill_deployment(Dice& dice, Scenario& scenario) {
  const std::uint32_t hosts = dice.count(2, 4);
  const auto size = dice.pick<std::uint32_t>({dice.count(2, 7), dice.count(2, 7), 7});
  for (std::uint32_t i = 0; i < size; ++i) {
    model::Participant p;
    p.host.value = dice.count(0, hosts - 1);
    p.publications = random_endpoints(dice);
    p.subscriptions = random_endpoints(dice);
    scenario.deployment.participants.push_back(p);
  }
  if (!scenario.deployment.has_cross_host_pair()) {
    std::uint32_t& host = scenario.deployment.participants.back().host.value;
    host = host == 0 ? 1 : 0;
  }
}

void fill_descriptors(Dice& dice, Scenario& scenario) {
  model::DescriptorProfile& d = scenario.dds.descriptors;
  d.default_publications = dice.pick<std::uint32_t>({0, 1, 2, 9, 9, 9, 32, dice.count(0, 12)});
  d.default_subscriptions = dice.pick<std::uint32_t>({0, 1, 2, 8, 8, 8, 32, dice.count(0, 12)});
  if (dice.chance(50)) {
    const std::int64_t lo = dice.between(60, 1200);
    const std::int64_t hi = lo + dice.pick<std::int64_t>({0, 1, 7, 80, dice.between(0, 900)});
    d.default_bytes = {Bytes{lo}, Bytes{hi}};
    d.user_bytes =
        Bytes{dice.pick<std::int64_t>({lo, 60, 1472, 1480, 2000, dice.between(60, 1200)})};
  }
  for (const model::Participant& p : scenario.deployment.participants) {
    if (p.publications + p.subscriptions > 0) return;
  }
  if (d.default_publications + d.default_subscriptions == 0) d.default_publications = 1;
}

void fill_sizes(Dice& dice, Scenario& scenario) {
  model::SedpProfile& sedp = scenario.dds.sedp;
  sedp.grouping = dice.pick<model::Grouping>({model::Grouping::message, model::Grouping::message,
                                              model::Grouping::mtu, model::Grouping::single});
  sedp.grouping_limit_bytes =
      Bytes{dice.pick<std::int64_t>({65'500, 65'500, 1'472, 60, dice.between(500, 9'000)})};
  sedp.piggyback =
      dice.pick<model::Piggyback>({model::Piggyback::cumulative, model::Piggyback::cumulative,
                                   model::Piggyback::linear, model::Piggyback::off});
  sedp.piggyback_threshold_bytes = Bytes{dice.pick<std::int64_t>(
      {106'496, 106'496, 1, 5'000, 1'000'000'000'000, dice.magnitude(1, 100'000)})};
  if (dice.chance(70)) return;
  scenario.dds.spdp.payload_bytes = Bytes{dice.pick<std::int64_t>({1, 420, 1'472, 1'473, 3'000})};
  sedp.heartbeat_bytes = Bytes{dice.pick<std::int64_t>({1, 68, 100, dice.between(1, 2'000)})};
  sedp.acknack_bytes = Bytes{dice.pick<std::int64_t>({1, 64, 100, dice.between(1, 2'000)})};
  sedp.piggyback_heartbeat_bytes = Bytes{dice.pick<std::int64_t>({1, 32, 700})};
  sedp.shared_header_bytes = Bytes{dice.pick<std::int64_t>({0, 1, 36, 60})};
}

void fill_protocol(Dice& dice, Scenario& scenario) {
  using Resend = model::SpdpResend;
  model::SedpProfile& p = scenario.dds.sedp;
  scenario.dds.spdp.resend = dice.pick<Resend>(
      {Resend::all_known, Resend::new_and_multicast, Resend::new_only, Resend::none});
  if (dice.chance(50)) p.relation_opening = model::RelationOpening::each_side;
  if (dice.chance(40)) p.initial_data = model::InitialData::pull;
  if (dice.chance(40)) p.unmatched = model::Unmatched::accept;
  p.initial_acknack = dice.pick<model::InitialAckNackReply>({model::InitialAckNackReply::bitmap,
                                                             model::InitialAckNackReply::heartbeat,
                                                             model::InitialAckNackReply::none});
  if (dice.chance(50)) p.acknowledge = model::Acknowledge::prefix;
  if (dice.chance(40)) p.heartbeat_timer = model::HeartbeatTimerKind::additive;
  if (dice.chance(40)) p.heartbeat_recipients = model::HeartbeatRecipients::matched;
  if (dice.chance(40)) p.heartbeat_policy = model::HeartbeatPolicy::adaptive;
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

void fill_starts(Dice& dice, const Clock& clock, Scenario& scenario) {
  const std::vector<std::int64_t> starts{0, 0, clock.on_grid(clock.scale / 4),
                                         clock.on_grid(dice.magnitude(1, clock.scale)),
                                         clock.on_grid(clock.scale)};
  const bool together = dice.chance(40);
  std::int64_t latest = 0;
  for (model::Participant& p : scenario.deployment.participants) {
    if (!together) p.start = Nanoseconds{dice.pick(starts)};
    latest = std::max(latest, p.start.count());
  }
  const std::int64_t limit = latest + clock.scale * dice.pick<std::int64_t>({1, 2, 4, 8, 16}) / 2;
  scenario.time_limit = Nanoseconds{std::clamp(limit, 1 * ms, 20 * s)};
}

}  // namespace

Scenario random_scenario(std::uint64_t seed) {
  Dice dice{seed};
  Scenario scenario;
  fill_deployment(dice, scenario);
  fill_descriptors(dice, scenario);
  fill_sizes(dice, scenario);
  fill_wireless(dice, scenario.wireless);
  fill_protocol(dice, scenario);
  const Clock clock = make_clock(dice, scenario);
  fill_timers(dice, clock, scenario.dds);
  fill_starts(dice, clock, scenario);
  return scenario;
}

}  // namespace stormproof::oracle
