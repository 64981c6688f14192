// The DDS profile of a random scenario: every rule, size and timer of every implementation. Where
// sizes and relation rules are constants of the implementation, a profile keeps their defaults.
#include <numeric>

#include "props/generators/draw.hpp"

namespace stormproof::props {

namespace {

using model::Bytes;
using model::Nanoseconds;
using model::Scenario;

constexpr std::int64_t longest_drawn_period = 1'000'000 * second;

void draw_descriptors(Dice& dice, Scenario& scenario) {
  model::DescriptorProfile& d = scenario.dds.descriptors;
  d.default_publications = dice.pick<std::uint32_t>({0, 1, 2, 9, 9, 9, 32, dice.count(0, 12)});
  d.default_subscriptions = dice.pick<std::uint32_t>({0, 1, 2, 8, 8, 8, 32, dice.count(0, 12)});
  if (dice.chance(50)) {
    const std::int64_t lo = dice.between(61, 1200);
    const std::int64_t hi = lo + dice.among({0, 1, 7, 80, dice.between(0, 900)});
    d.default_bytes = {Bytes{lo}, Bytes{hi}};
    d.user_bytes = Bytes{dice.among({lo, 61, 1'472, 1'480, 2'000, dice.between(61, 1200)})};
  }
  for (const model::Participant& p : scenario.deployment.participants) {
    if (p.publications + p.subscriptions > 0) return;
  }
  if (d.default_publications + d.default_subscriptions == 0) d.default_publications = 1;
}

void draw_message_limit(Dice& dice, model::SedpProfile& sedp) {
  sedp.grouping_limit_bytes =
      Bytes{dice.among({65'500, 65'500, 1'472, 60, dice.between(500, 9'000)})};
}

void draw_sizes(Dice& dice, Scenario& scenario) {
  model::SedpProfile& sedp = scenario.dds.sedp;
  sedp.grouping = dice.choice<model::Grouping>(3);
  draw_message_limit(dice, sedp);
  if (dice.chance(60)) return;
  scenario.dds.spdp.payload_bytes = Bytes{dice.among({1, 420, 1'472, 1'473, 3'000})};
  sedp.heartbeat_bytes = Bytes{dice.among({1, 68, 100, dice.between(1, 2'000)})};
  sedp.acknack_bytes = Bytes{dice.among({1, 64, 100, dice.between(1, 2'000)})};
  sedp.piggyback_heartbeat_bytes = Bytes{dice.among({1, 32, 700})};
  sedp.shared_header_bytes = Bytes{dice.among({1, 2, 36, 60})};
}

void draw_relation_rules(Dice& dice, model::SedpProfile& p) {
  p.relation_opening = dice.choice<model::RelationOpening>(2);
  p.initial_data = dice.choice<model::InitialData>(2);
  p.unmatched = dice.choice<model::Unmatched>(2);
  p.initial_acknack = dice.choice<model::InitialAckNackReply>(3);
  p.acknowledge = dice.choice<model::Acknowledge>(2);
  p.heartbeat_timer = dice.choice<model::HeartbeatTimerKind>(2);
  p.heartbeat_recipients = dice.choice<model::HeartbeatRecipients>(2);
}

// A threshold between nothing, which adds a HEARTBEAT to every DATA, and one that no run reaches.
void draw_piggyback(Dice& dice, model::SedpProfile& sedp) {
  sedp.piggyback = dice.choice<model::Piggyback>(3);
  sedp.piggyback_threshold_bytes = Bytes{
      dice.among({106'496, 106'496, 0, 1, dice.between(300, 1'500), dice.between(1'000, 20'000),
                  1'000'000'000'000, dice.magnitude(1, 100'000)})};
}

// Delays that follow each other end when a period does, or when another delay does.
void let_sums_meet(Dice& dice, model::SedpProfile& sedp) {
  const Nanoseconds reply = sedp.heartbeat_response_delay + sedp.nack_response_delay;
  const Nanoseconds sum = reply + sedp.nack_suppression_duration;
  if (reply == Nanoseconds{0}) return;
  Nanoseconds* const delays[] = {&sedp.initial_acknack_delay, &sedp.nack_suppression_duration,
                                 &sedp.heartbeat_period};
  const std::int64_t which = dice.between(0, 2);
  const Nanoseconds enough{1'000 * second};
  const Nanoseconds shortest =
      which == 2 ? std::min(sedp.heartbeat_period, enough) : Nanoseconds{0};
  const Nanoseconds meeting = which != 1 && dice.chance(50) ? sum : reply;
  std::int64_t times = 1;  // a period does not get shorter, or its events would fill the run
  while (meeting * times < shortest) times *= 2;
  *delays[which] = meeting * times;
}

void draw_cyclone_rules(Dice& dice, model::DdsProfile& dds) {
  dds.allow_multicast = dice.choice<model::AllowMulticast>(2);
  dds.spdp.directed_replies = dice.pick<std::uint32_t>({4, 4, 0, 1, 2});
  model::SedpProfile& sedp = dds.sedp;
  sedp.max_message_size = Bytes{dice.among({14'720, 14'720, 60, 1'472, dice.between(300, 3'000)})};
  sedp.max_rexmit_message_size =
      Bytes{dice.among({1'456, 1'456, 60, 14'720, dice.between(300, 3'000)})};
  sedp.max_queued_rexmit_messages =
      dice.pick<std::uint32_t>({200, 200, 1, 2, 5, dice.count(0, 30)});
  sedp.merge_queued_rexmit = dice.chance(75) ? model::MergeQueued::yes : model::MergeQueued::no;
}

void draw_cyclone_timers(Dice& dice, const Clock& clock, model::DdsProfile& dds) {
  dds.spdp.period = draw_period(dice, clock);
  dds.spdp.startup_period = draw_period(dice, clock);
  dds.spdp.directed_reply_interval = draw_period(dice, clock);
  model::SedpProfile& sedp = dds.sedp;
  sedp.heartbeat_interval = draw_period(dice, clock);
  const std::int64_t most = sedp.heartbeat_interval.count() * dice.among({1, 2, 3, 4, 80});
  sedp.heartbeat_interval_max = Nanoseconds{std::min(most, longest_drawn_period)};
  sedp.match_heartbeat_delay = draw_reaction(dice, clock, clock.scale / 50);
  sedp.ack_delay = draw_reaction(dice, clock, clock.scale / 10);
  sedp.nack_delay =
      dice.chance(30) ? draw_reaction(dice, clock, clock.scale / 10) : draw_period(dice, clock);
  sedp.auto_resched_nack_delay = draw_period(dice, clock);
  sedp.preemptive_ack_delay = draw_reaction(dice, clock, clock.scale / 10);
}

}  // namespace

void draw_rules_and_sizes(Dice& dice, Scenario& scenario) {
  if (model::traits_of(scenario.dds).has_own_timers) {
    draw_cyclone_rules(dice, scenario.dds);
    return;
  }
  scenario.dds.spdp.resend = dice.choice<model::SpdpResend>(4);
  if (dice.chance(40)) scenario.dds.sedp.heartbeat_policy = model::HeartbeatPolicy::adaptive;
  draw_piggyback(dice, scenario.dds.sedp);
  const model::ImplementationTraits& traits = model::traits_of(scenario.dds);
  if (!traits.fixed_rules) draw_relation_rules(dice, scenario.dds.sedp);
  if (!traits.has_size_knobs) {
    draw_message_limit(dice, scenario.dds.sedp);
    return;
  }
  draw_sizes(dice, scenario);
  draw_descriptors(dice, scenario);
}

void draw_timers(Dice& dice, const Clock& clock, model::DdsProfile& dds) {
  if (model::traits_of(dds).has_own_timers) {
    draw_cyclone_timers(dice, clock, dds);
    return;
  }
  dds.spdp.period = draw_period(dice, clock);
  dds.spdp.startup_period = draw_period(dice, clock);
  dds.spdp.startup_announcements = dice.pick<std::uint32_t>({5, 5, 0, 1, 2});
  model::SedpProfile& sedp = dds.sedp;
  sedp.heartbeat_period = draw_period(dice, clock);
  sedp.heartbeat_response_delay = draw_reaction(dice, clock, 10 * microsecond);
  sedp.nack_response_delay = draw_reaction(dice, clock, 100 * microsecond);
  sedp.nack_suppression_duration = draw_reaction(dice, clock, 10 * microsecond);
  sedp.initial_acknack_delay = draw_reaction(dice, clock, clock.scale / 4);
  if (dice.chance(25)) let_sums_meet(dice, sedp);
  model::AdaptiveProfile& adaptive = sedp.adaptive;
  adaptive.min_period = draw_period(dice, clock);
  const std::int64_t longest = adaptive.min_period.count() * dice.among({1, 2, 10, 100});
  adaptive.max_period = Nanoseconds{std::min(longest, longest_drawn_period)};
  const std::int64_t numerator = dice.among({1, 1, 1, 2, 3});
  const std::int64_t denominator = dice.among({20, 20, 3, 4, 7, 1'000});
  const std::int64_t common = std::gcd(numerator, denominator);
  adaptive.epsilon_numerator = numerator / common;
  adaptive.epsilon_denominator = denominator / common;
}

void draw_notification(Dice& dice, model::DdsProfile& dds) {
  if (!model::traits_of(dds).has_own_timers) return;
  dds.sedp.notification = dice.choice<model::Notification>(2);
}

void draw_attempts(Dice& dice, const Clock& clock, model::SedpProfile& sedp) {
  if (!dice.chance(30)) return;
  sedp.initial_acknack_interval = model::InitialAckNackInterval::constant;
  const bool enabled = sedp.initial_acknack_delay > Nanoseconds{0};
  if (enabled && sedp.initial_acknack_delay.count() < clock.scale / 10) {
    sedp.initial_acknack_delay = draw_period(dice, clock);
  }
}

}  // namespace stormproof::props
