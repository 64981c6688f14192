// The bounds of live.quiescence and live.completion: their formulas, that they hold, that the one
// of quiescence is nearly reached, and that the monitors object beyond them.
#include <gtest/gtest.h>

#include "props/monitors/completion.hpp"
#include "props/monitors/delay_meter.hpp"
#include "props/monitors/monitors.hpp"
#include "props/monitors/quiescence.hpp"
#include "tests/oracle/random_scenario.hpp"
#include "tests/props/monitored_run.hpp"

namespace stormproof::props {
namespace bounds_test {

using model::Nanoseconds;

constexpr std::int64_t us = 1'000;
constexpr std::int64_t ms = 1'000'000;
constexpr std::int64_t sec = 1'000'000'000;

std::int64_t quiet(const model::DdsProfile& dds, std::int64_t delay) {
  return quiescence_bound(dds, Nanoseconds{delay}).count();
}

TEST(QuiescenceBound, OfThePapersProfile) {
  const model::DdsProfile dds;
  EXPECT_EQ(quiet(dds, ms), sec + ms + 10 * us);                  // one more expiry, and its answer
  EXPECT_EQ(quiet(dds, 500 * ms), 2 * sec + 500 * ms + 10 * us);  // answers take longer than τ_H
}

TEST(QuiescenceBound, OfOtherPolicies) {
  model::DdsProfile dds;
  dds.sedp.heartbeat_timer = model::HeartbeatTimerKind::additive;
  EXPECT_EQ(quiet(dds, ms), sec + 3 * ms + 20 * us);
  dds.sedp.heartbeat_policy = model::HeartbeatPolicy::adaptive;
  EXPECT_EQ(quiet(dds, ms), 3 * sec + 1 + 3 * ms + 20 * us);
  dds = {};
  dds.sedp.initial_acknack = model::InitialAckNackReply::heartbeat;
  EXPECT_EQ(quiet(dds, ms), sec + 3 * ms + 10 * us);
  dds = {};
  dds.implementation = model::ImplementationKind::fastdds;
  EXPECT_EQ(quiet(dds, ms), (sec + 2 * ms) + sec + ms + 10 * us);
  dds.sedp.initial_acknack_delay = Nanoseconds{};
  EXPECT_EQ(quiet(dds, ms), (ms + 110 * us) + sec + ms + 10 * us);
}

/// A HEARTBEAT and its answer after τ_H: 997.9 ms of a bound of 1001.01 ms.
TEST(QuiescenceBound, IsNearlyReached) {
  const MonitoredRun run = run_monitored(shipped(
      "smallest",
      {"wireless={kind: constant_delay, one_way: 1ms, lost_packets: [6]}", "dds.sedp.piggyback=off",
       "dds.sedp.initial_acknack_delay=0s", "run_until=time_limit", "time_limit=10s"}));
  EXPECT_EQ(run.violated(), "storm.join-cost");
  EXPECT_EQ(run.remarks("live.quiescence"),
            "The last SEDP packet left 997.9 ms after completion; the bound is 1.00101 s for "
            "packets that take at most 1 ms.\n");
}

/// Whether the run of this scenario shows that the bound holds, with a time limit beyond it.
bool shows_silence(model::Scenario scenario) {
  const model::RunResult discovery = model::simulate(scenario);
  if (!discovery.discovery_time || !scenario.wireless.lost_packets.empty()) return false;
  if (scenario.dds.sedp.relation_opening == model::RelationOpening::each_side) return false;
  scenario.run_until = model::RunUntil::time_limit;
  scenario.time_limit = *discovery.discovery_time * 3 + Nanoseconds{2 * sec};
  const auto monitor = make_quiescence_monitor(scenario);
  model::RunOptions options;
  options.probe = monitor.get();
  options.max_events = 30'000;
  const model::RunResult result = model::simulate(scenario, options);
  monitor->finish(result.end_time);
  if (monitor->violation()) ADD_FAILURE() << monitor->violation()->reason;
  return monitor->silent_from(result.end_time) &&
         *monitor->silent_from(result.end_time) < result.end_time;
}

TEST(QuiescenceBound, HoldsOnRandomScenarios) {
  int shown = 0;
  for (std::uint64_t seed = 1'000; seed < 1'400; ++seed) {
    if (shows_silence(oracle::random_scenario(seed))) ++shown;
    model::Scenario scenario = oracle::random_fastdds_scenario(seed);
    scenario.dds.implementation = model::ImplementationKind::fastdds;
    if (shows_silence(scenario)) ++shown;
  }
  EXPECT_GT(shown, 40);
}

TEST(CompletionBound, GrowsWithDelayAndLosses) {
  const model::DdsProfile dds;
  const std::int64_t round = sec + 3 * ms + 120 * us;
  EXPECT_EQ(completion_bound(dds, Nanoseconds{ms}, 0).count(), 3 * sec + ms + 2 * round);
  EXPECT_EQ(completion_bound(dds, Nanoseconds{ms}, 2).count(), 9 * sec + ms + 6 * round);
}

/// The longest relation of the smallest deployment takes 14.150436 ms.
TEST(CompletionMonitor, ObjectsToWhatTakesLongerThanTheGivenBound) {
  const model::Scenario scenario = shipped("smallest");
  for (const auto& [bound, holds] : {std::pair{14'150'436, true}, {14'150'435, false}}) {
    const auto monitor = watch_completion(scenario, Nanoseconds{bound});
    model::RunOptions options;
    options.probe = monitor.get();
    const model::RunResult result = model::simulate(scenario, options);
    monitor->finish(result.end_time);
    EXPECT_EQ(!monitor->violation().has_value(), holds) << bound;
  }
}

TEST(CompletionMonitor, ObjectsToAnOpenRelationThatIsStillIncomplete) {
  model::Scenario scenario = shipped("smallest", {"time_limit=10ms"});
  const auto monitor = watch_completion(scenario, Nanoseconds{ms});
  model::RunOptions options;
  options.probe = monitor.get();
  static_cast<void>(model::simulate(scenario, options));
  monitor->finish(scenario.time_limit);
  ASSERT_TRUE(monitor->violation());
  EXPECT_EQ(monitor->violation()->time, scenario.time_limit);
}

TEST(CompletionMonitor, MeasuresDelayAndLosses) {
  const MonitoredRun run = run_monitored(shipped("smallest", {"wireless.lost_packets=[3,9]"}));
  EXPECT_NE(run.remarks("live.completion").find(", 2 packets lost."), std::string::npos);
}

}  // namespace bounds_test
}  // namespace stormproof::props
