// The gain against runs: without a loss, and whatever delays the channel makes, no run of a gain
// below 1 repairs more than the series says; and a single late packet is absorbed.
#include "checker/engines/calculus/gain.hpp"

#include <gtest/gtest.h>

#include "model/implementations.hpp"
#include "model/simulator.hpp"
#include "props/generators/dice.hpp"
#include "props/generators/space.hpp"
#include "tests/checker/engines/timeline/requests.hpp"

namespace stormproof::calculus {
namespace gain_test {

using model::Nanoseconds;

TEST(Gain, NoRunRepairsMoreThanTheSeries) {
  props::ScenarioSpace space;
  space.max_endpoints = 8;
  space.losses = false;
  int below_one = 0;
  int with_repairs = 0;
  std::uint64_t nearest = 1'000'000;
  for (std::uint64_t seed = 1; seed <= 500; ++seed) {
    props::Dice dice{seed ^ 0x6A17'0000};
    space.implementation = dice.pick(model::known_to_engines());
    model::Scenario scenario = props::draw_scenario(seed, 100, space);
    if (dice.chance(60)) {
      scenario.dds.sedp.piggyback = model::Piggyback::linear;
      scenario.dds.sedp.piggyback_threshold_bytes = model::Bytes{dice.between(20'000, 60'000)};
    }
    const auto gain = gain_of(scenario);
    if (!gain) continue;
    model::RunOptions options;
    options.max_events = 60'000;
    const model::RunResult result = model::simulate(scenario, options);
    const auto most = gain->repairs(result.end_time);
    if (!most) continue;
    ++below_one;
    if (result.counts.repair_data == 0) continue;
    ++with_repairs;
    EXPECT_LE(static_cast<std::int64_t>(result.counts.repair_data), *most) << "seed " << seed;
    nearest = std::min(nearest, static_cast<std::uint64_t>(*most) / result.counts.repair_data);
  }
  EXPECT_GT(below_one, 100);
  EXPECT_GT(with_repairs, 30);
  EXPECT_LT(nearest, 20U);  // it is a bound of this order of magnitude
}

TEST(Gain, OfProfiles) {
  model::Scenario scenario;
  scenario.deployment = model::Deployment::homogeneous(2, 5, 20);
  EXPECT_FALSE(
      gain_of(scenario)->worst.is_below_one());  // cumulative: five readers, 19 descriptors
  EXPECT_EQ(gain_of(scenario)->worst.value(), 95);
  scenario.dds.sedp.piggyback = model::Piggyback::linear;
  EXPECT_TRUE(gain_of(scenario)->worst.is_below_one());
  EXPECT_EQ(gain_of(scenario)->worst.bytes, 532);
  scenario.dds.sedp.piggyback = model::Piggyback::off;
  EXPECT_EQ(gain_of(scenario)->worst.value(), 0);
  scenario.dds.sedp.heartbeat_timer = model::HeartbeatTimerKind::additive;
  EXPECT_FALSE(gain_of(scenario));
}

TEST(Gain, TheSeriesIsProvedAndTight) {
  const WriterGain gain{.descriptors = 3, .readers = 2, .bytes = 10, .budget = 101, .pushed = 60};
  for (const std::int64_t more : {0, 200}) {
    WriterGain claimed = gain;
    claimed.pushed += more;
    EXPECT_TRUE(
        timeline::is_proved([&](timeline::Theorem& theorem) { prove_gain(theorem, claimed, 4); }));
  }
  EXPECT_EQ(gain.repairs(4), 3 * (4 * 101 + 2 * 60) / (101 - 60));
}

/// One packet takes long, all others less than the readers wait.
std::uint64_t repairs_with_late(model::Scenario scenario, std::uint64_t packet, Nanoseconds delay) {
  scenario.wireless.packet_delays = {{packet, Nanoseconds{0}, delay}};
  return model::simulate(scenario).counts.repair_data;
}

TEST(Gain, OneLatePacketIsAbsorbed) {
  model::Scenario scenario;
  scenario.deployment = model::Deployment::homogeneous(2, 2, 4);
  scenario.wireless.kind = model::ServiceKind::constant_delay;
  scenario.wireless.one_way = Nanoseconds{5'000};
  scenario.dds.sedp.piggyback = model::Piggyback::linear;
  scenario.run_until = model::RunUntil::time_limit;
  scenario.time_limit = Nanoseconds{4'000'000'000};
  ASSERT_EQ(model::simulate(scenario).counts.repair_data, 0U);
  std::uint64_t most = 0;
  for (std::uint64_t packet = 0; packet < 80; ++packet) {
    for (const std::int64_t delay : {6'000, 16'000, 300'000, 80'000'000, 1'500'000'000}) {
      most = std::max(most, repairs_with_late(scenario, packet, Nanoseconds{delay}));
    }
  }
  EXPECT_EQ(most, 11U);  // the descriptors of the largest packet, once
}

}  // namespace gain_test
}  // namespace stormproof::calculus
