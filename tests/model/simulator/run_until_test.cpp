// What ends a run: the completion of discovery, or with `run_until: time_limit` the time limit
// alone; and the limit on events.
#include <gtest/gtest.h>

#include "tests/model/run_log.hpp"

namespace stormproof::model {
namespace run_until_test {

Scenario beyond(Scenario scenario, std::int64_t time_limit_ns) {
  scenario.run_until = RunUntil::time_limit;
  scenario.time_limit = Nanoseconds{time_limit_ns};
  return scenario;
}

TEST(RunUntilTimeLimit, GoesOnAfterCompletionAndRemembersWhenItWas) {
  const Scenario scenario = by_hand({{0, 2}, {1, 2}});
  const RunLog ends = run_and_log(scenario);
  const RunLog goes_on = run_and_log(beyond(scenario, 10 * sec));
  EXPECT_EQ(ends.result.end, RunEnd::completed);
  EXPECT_EQ(goes_on.result.end, RunEnd::time_limit);
  EXPECT_TRUE(goes_on.result.completed());
  EXPECT_EQ(goes_on.result.discovery_time, ends.result.discovery_time);
  EXPECT_EQ(goes_on.result.end_time, Nanoseconds{9 * sec + 501 * ms});  // announcements go on
  EXPECT_GT(goes_on.result.counts.acknack, ends.result.counts.acknack);
  EXPECT_EQ(goes_on.result.counts.initial_data, ends.result.counts.initial_data);
  ASSERT_TRUE(goes_on.result.last_delivery && ends.result.last_delivery);
  EXPECT_EQ(goes_on.result.last_delivery->received, ends.result.last_delivery->received);
  EXPECT_EQ(goes_on.result.last_delivery->descriptor.descriptor,
            ends.result.last_delivery->descriptor.descriptor);
}

TEST(RunUntilTimeLimit, TheRunsAreTheSameUpToCompletion) {
  for (const auto implementation : {ImplementationKind::paper, ImplementationKind::fastdds}) {
    Scenario scenario;
    scenario.deployment = Deployment::homogeneous(2, 2, 10);
    scenario.dds.implementation = implementation;
    const RunLog ends = run_and_log(scenario);
    const RunLog goes_on = run_and_log(beyond(scenario, ends.result.end_time.count() + ms));
    EXPECT_EQ(goes_on.result.discovery_time, ends.result.discovery_time);
    ASSERT_LE(ends.sent.size(), goes_on.sent.size());
    for (std::size_t k = 0; k < ends.sent.size(); ++k) {
      EXPECT_EQ(ends.sent[k].time_ns, goes_on.sent[k].time_ns);
      EXPECT_EQ(ends.sent[k].kind, goes_on.sent[k].kind);
    }
  }
}

TEST(RunUntilTimeLimit, ThePacketThatCompletesDiscoveryIsProcessedToItsEnd) {
  // A single DATA packet with a HEARTBEAT in it is all there is to discover.
  Scenario scenario = by_hand({{0, 2}, {1, 0}});
  scenario.dds.sedp.piggyback = Piggyback::linear;
  scenario.dds.sedp.piggyback_threshold_bytes = Bytes{500};
  const auto generations = [](const RunLog& log) {
    std::size_t count = 0;
    for (const Scheduled& event : log.scheduled) {
      count += event.kind == EventKind::acknack_generation &&
                       event.at_ns == log.result.discovery_time->count() && event.subject == 0
                   ? 1U
                   : 0U;
    }
    return count;
  };
  const RunLog ends = run_and_log(scenario);
  const RunLog goes_on = run_and_log(beyond(scenario, 50 * ms));
  ASSERT_TRUE(ends.result.completed() && goes_on.result.completed());
  EXPECT_EQ(generations(ends), 0U);
  EXPECT_EQ(generations(goes_on), 2U);  // of that packet, and of the HEARTBEAT that follows it
}

TEST(RunUntilTimeLimit, AQueueThatRunsDryEndsIt) {
  Scenario scenario = by_hand({{0, 1}, {1, 1}});
  Mutation once;  // announcement k + 1 is never scheduled
  once.tables.push_back({"Announcer", 0, fsm::TableMutation::Kind::drop_action, 0, 0});
  const RunLog log = run_and_log(beyond(scenario, 100 * sec), &once);
  EXPECT_EQ(log.result.end, RunEnd::no_more_events);
  EXPECT_FALSE(log.result.completed());
  EXPECT_FALSE(log.result.discovery_time);
}

TEST(MaxEvents, InterruptsTheRunAfterExactlySoMany) {
  const Scenario scenario = by_hand({{0, 2}, {1, 2}});
  const std::uint64_t all = simulate(scenario).events;
  RunOptions options;
  options.max_events = all - 1;
  const RunResult cut = simulate(scenario, options);
  EXPECT_EQ(cut.end, RunEnd::interrupted);
  EXPECT_EQ(cut.events, all - 1);
  EXPECT_FALSE(cut.completed());
  options.max_events = all;
  EXPECT_EQ(simulate(scenario, options).end, RunEnd::completed);
}

}  // namespace run_until_test
}  // namespace stormproof::model
