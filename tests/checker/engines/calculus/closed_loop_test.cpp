// The closed loop against runs that repair: random deployments of both writers over channels and
// links, with start times drawn anew. No packet takes longer than D*, nobody repairs or sends more,
// and discovery is complete in time. A bound that forgets something is noticed by the same
// comparison.
#include "checker/engines/calculus/closed_loop.hpp"

#include <array>
#include <map>

#include <fmt/core.h>
#include <gtest/gtest.h>

#include "checker/engines/calculus/gain.hpp"
#include "tests/checker/engines/calculus/covered_scenarios.hpp"
#include "tests/checker/engines/calculus/observed_delays.hpp"
#include "tests/checker/engines/timeline/requests.hpp"

namespace stormproof::calculus {
namespace closed_loop_test {

using model::Nanoseconds;

constexpr std::uint64_t deployments = 1'000;

/// Timers that are short for the delays of the deployment, but not so short that repairs have no
/// bound; or budgets that repairs use up, with a gain just below 1.
model::Scenario late_scenario(std::uint64_t seed) {
  model::Scenario scenario = covered_scenario(seed);
  props::Dice dice{seed ^ 0xC105'0000};
  model::SedpProfile& sedp = scenario.dds.sedp;
  const Judged open = judge(scenario);
  if (!open.delay) return scenario;
  const Nanoseconds delay = std::max(*open.delay, Nanoseconds{4});
  sedp.heartbeat_period = std::max(sedp.heartbeat_period, delay * dice.between(1, 4));
  if (model::traits_of(scenario.dds).writer == model::Writer::stateful) {
    sedp.heartbeat_response_delay = Nanoseconds{delay.count() / dice.among({1, 2, 4, 8, 16, 64})};
    if (open.busy) {
      sedp.piggyback = dice.chance(70) ? model::Piggyback::off : model::Piggyback::linear;
    } else {
      sedp.piggyback_threshold_bytes = model::Bytes{dice.between(2'000, 60'000)};
    }
    scenario.wireless.fragment_request = model::FragmentRequest::at_admission;
    return scenario;
  }
  sedp.heartbeat_response_delay = Nanoseconds{delay.count() / 100};
  if (dice.chance(40)) {
    sedp.initial_acknack_delay = Nanoseconds{delay.count() / dice.among({4, 16, 64})};
    sedp.piggyback = model::Piggyback::linear;
    const auto gain = gain_of(scenario);
    if (!gain) return scenario;  // additive timers
    const WriterGain& writer = gain->worst;
    const std::int64_t one_copy = writer.bytes * writer.readers * writer.descriptors;
    sedp.piggyback_threshold_bytes = model::Bytes{one_copy * dice.between(105, 300) / 100};
  }
  return scenario;
}

/// What a run does that the bound says it cannot; empty: nothing.
std::string excess(const Observed& run, const ClosedLoop& loop) {
  const auto above = [](const char* what, std::int64_t measured, std::int64_t most) {
    return measured > most ? fmt::format("{}: {}, not at most {}; ", what, measured, most)
                           : std::string{};
  };
  Nanoseconds latest;
  for (const model::Participant& p : run.scenario.deployment.participants) {
    latest = std::max(latest, p.endpoints_done);
  }
  const model::Counts& counts = run.result.counts;
  const auto total =
      static_cast<std::int64_t>(counts.initial_data + counts.repair_data + counts.heartbeat +
                                counts.acknack + counts.spdp_multicast + counts.spdp_unicast);
  std::string text = above("delay", run.longest.count(), loop.delay->count());
  text += above("repairs", static_cast<std::int64_t>(counts.repair_data), loop.repairs.sent);
  text += above("messages", total, loop.messages(run.result.end_time));
  std::int64_t heartbeats = 0;
  for (const Flow& flow : loop.traffic.flows) {
    if (flow.traffic != model::TrafficClass::heartbeat) continue;
    heartbeats = plus(heartbeats, times(flow.messages, flow.when.most(run.result.end_time.count(),
                                                                      loop.delay->count())));
  }
  text += above("HEARTBEATs", static_cast<std::int64_t>(counts.heartbeat), heartbeats);
  const Nanoseconds complete = run.result.discovery_time.value_or(run.result.end_time);
  text += above("completion", complete.count(), (latest + loop.completion).count());
  if (loop.silence) {
    const Nanoseconds silent_from = latest + loop.completion + *loop.silence;
    text += above("last of SEDP", run.last_sedp.count(), silent_from.count());
  }
  for (const model::ChannelUse& channel : run.result.channels) {
    std::int64_t busy = 0;
    for (const Nanoseconds part : channel.busy) busy += part.count();
    text +=
        above("airtime", busy, loop.traffic.work(run.result.end_time.count(), loop.delay->count()));
  }
  return text;
}

template <class Use>
void for_late_runs(const Use& use) {
  for (std::uint64_t seed = 1; seed <= deployments; ++seed) {
    model::Scenario scenario = late_scenario(seed);
    const ClosedLoop loop = closed_loop(scenario);
    if (!loop.delay) continue;
    for (std::uint64_t k = 0; k < 3; ++k) {
      if (k > 0) draw_starts(scenario, 1'000 * seed + k);
      use(seed, run_of(scenario, *loop.delay, loop.silence.value_or(Nanoseconds{})), loop);
    }
  }
}

TEST(ClosedLoop, NoRunExceedsTheBound) {
  std::map<model::Writer, int> repaired;
  int shared = 0;
  for_late_runs([&](std::uint64_t seed, const Observed& run, const ClosedLoop& loop) {
    EXPECT_EQ(excess(run, loop), "") << "seed " << seed;
    if (run.result.counts.repair_data == 0) return;
    ++repaired[model::traits_of(run.scenario.dds).writer];
    if (loop.busy) ++shared;
  });
  EXPECT_GT(repaired[model::Writer::of_the_paper], 60);
  EXPECT_GT(repaired[model::Writer::stateful], 30);
  EXPECT_GT(shared, 80);
}

TEST(ClosedLoop, ABoundThatForgetsSomethingIsNoticed) {
  constexpr std::array<std::pair<const char*, Omission>, 4> omissions{
      {{"repairs", {.repairs = true}},
       {"HEARTBEATs that repairs add to", {.caused = true}},
       {"HEARTBEATs that DATA causes", {.piggyback = true}},
       {"HEARTBEATs of openings and timers", {.heartbeats = true}}}};
  std::array<int, omissions.size()> noticed{};
  for_late_runs([&](std::uint64_t, const Observed& run, const ClosedLoop&) {
    for (std::size_t k = 0; k < omissions.size(); ++k) {
      const ClosedLoop wrong = closed_loop(run.scenario, omissions[k].second);
      if (wrong.delay && !excess(run, wrong).empty()) ++noticed[k];
    }
  });
  for (std::size_t k = 0; k < omissions.size(); ++k) {
    EXPECT_GT(noticed[k], 0) << omissions[k].first;
  }
}

/// Two hosts with two nodes each, whose HEARTBEATs overtake DATA.
model::Scenario overtaken(model::Piggyback piggyback) {
  model::Scenario scenario;
  scenario.deployment = model::Deployment::homogeneous(2, 2, 4);
  scenario.dds.sedp.piggyback = piggyback;
  return scenario;
}

TEST(ClosedLoop, ExistsWhereRepairsCannotFeedThemselves) {
  const ClosedLoop off = closed_loop(overtaken(model::Piggyback::off));
  ASSERT_TRUE(off.delay) << off.gap;
  EXPECT_GT(off.repairs.copies, 0);
  EXPECT_LT(off.gain.value(), 1);
  EXPECT_GT(*off.delay, *judge(overtaken(model::Piggyback::off)).delay);
  const ClosedLoop cumulative = closed_loop(overtaken(model::Piggyback::cumulative));
  EXPECT_FALSE(cumulative.delay);
  EXPECT_FALSE(cumulative.gain);  // one repair causes the next
  EXPECT_NE(cumulative.gap.find("busy for longer"), std::string::npos) << cumulative.gap;
}

TEST(ClosedLoop, OneNanosecondLessIsRefuted) {
  const ClosedLoop right = closed_loop(overtaken(model::Piggyback::off));
  for (const std::int64_t less : {0, 1}) {
    ClosedLoop claimed = right;
    claimed.busy = *right.busy - Nanoseconds{less};
    EXPECT_EQ(timeline::is_proved(
                  [&](timeline::Theorem& theorem) { prove_closed_loop(theorem, claimed); }),
              less == 0);
  }
}

TEST(ClosedLoop, ALinkHasItsOwnDelay) {
  model::Scenario scenario = overtaken(model::Piggyback::cumulative);
  scenario.wireless.kind = model::ServiceKind::constant_delay;
  scenario.wireless.one_way = Nanoseconds{100'000};
  const ClosedLoop loop = closed_loop(scenario);
  ASSERT_TRUE(loop.delay);
  EXPECT_EQ(*loop.delay, Nanoseconds{100'000});
}

TEST(ClosedLoop, HasNoBoundOfWhatItDoesNotKnow) {
  model::Scenario lossy = overtaken(model::Piggyback::off);
  lossy.wireless.lost_packets = {3};
  EXPECT_FALSE(closed_loop(lossy).delay);
  model::Scenario additive = overtaken(model::Piggyback::off);
  additive.dds.sedp.heartbeat_timer = model::HeartbeatTimerKind::additive;
  EXPECT_FALSE(closed_loop(additive).delay);
  model::Scenario cyclone = overtaken(model::Piggyback::off);
  cyclone.dds.implementation = model::ImplementationKind::cyclone;
  EXPECT_FALSE(closed_loop(cyclone).delay);
}

/// What has been received is never asked for again: whatever the gain, a storm without a loss ends.
TEST(ClosedLoop, WithoutALossEveryStormEnds) {
  std::uint64_t largest = 0;
  for (const std::uint32_t nodes : {2U, 5U}) {
    for (const std::int64_t threshold : {60'000, 106'496}) {
      model::Scenario scenario = overtaken(model::Piggyback::cumulative);
      scenario.deployment = model::Deployment::homogeneous(2, nodes, 20);
      scenario.dds.sedp.piggyback_threshold_bytes = model::Bytes{threshold};
      scenario.run_until = model::RunUntil::quiescence;
      ASSERT_GE(gain_of(scenario)->worst.value(), 1);
      model::RunOptions options;
      options.max_events = 2'000'000;
      const model::RunResult result = model::simulate(scenario, options);
      EXPECT_EQ(result.end, model::RunEnd::no_more_events);
      EXPECT_TRUE(result.discovery_time);
      largest = std::max(largest, result.counts.repair_data / result.counts.initial_data);
    }
  }
  EXPECT_GE(largest, 2U);  // not only the first copies were repaired
}

}  // namespace closed_loop_test
}  // namespace stormproof::calculus
