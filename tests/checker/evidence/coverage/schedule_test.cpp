// Where schedules are drawn from, and which rows belong to a channel.
#include <gtest/gtest.h>

#include "examples.hpp"
#include "model/config/scenario_file.hpp"

namespace stormproof::prediction {
namespace schedule_test {

TEST(Schedule, MeasuredStartsAreTakenAsTheyAre) {
  Configuration c = configuration_of({50, 60});
  for (Observation& run : c.runs) run.start = Range{4, 20};
  for (Observation& run : c.runs) run.endpoints_done = Range{30, 60};
  const ScheduleRanges ranges = schedule_ranges(c);
  EXPECT_EQ(ranges.start.low, 4);
  EXPECT_EQ(ranges.start.high, 20);
  EXPECT_EQ(ranges.endpoints_done.high, 60);
}

TEST(Schedule, RangesAreMediansOverTheRuns) {
  Configuration c = configuration_of({50, 60, 70});
  c.runs[0].endpoints_done = Range{10, 40};
  c.runs[1].endpoints_done = Range{20, 90};
  c.runs[2].endpoints_done = Range{30, 60};
  EXPECT_EQ(schedule_ranges(c).endpoints_done.low, 20);
  EXPECT_EQ(schedule_ranges(c).endpoints_done.high, 60);
}

TEST(Schedule, StartsEndWithTheShareOfTheParticipantInItsCreation) {
  Configuration c = configuration_of({50}, 2, 17);  // 34 endpoints: half of the time is the
  c.runs[0].endpoints_done = Range{30, 60};         // participant's own
  EXPECT_EQ(schedule_ranges(c).start.low, 3);
  EXPECT_EQ(schedule_ranges(c).start.high, 30);
}

TEST(Schedule, WithoutMeasurementTheFitOfTheLiveMachine) {
  const ScheduleRanges ranges = schedule_ranges(configuration_of({50}, 5, 20));
  EXPECT_NEAR(ranges.endpoints_done.low, 50.8, 1e-9);
  EXPECT_NEAR(ranges.endpoints_done.high, 134.175, 1e-9);
  const ScheduleRanges small = schedule_ranges(configuration_of({50}, 1, 2));
  EXPECT_LE(small.endpoints_done.low, small.endpoints_done.high);
  EXPECT_LE(small.start.low, small.start.high);
}

TEST(Schedule, ParticipantsOfCycloneHearBeforeTheyAnnounceThemselves) {
  Configuration c = configuration_of({50, 60}, 5, 20);
  ScheduleRanges ranges = schedule_ranges(c, model::Writer::of_cyclone);
  EXPECT_EQ(ranges.start.low, 2);
  EXPECT_EQ(ranges.start.high, 20);
  EXPECT_NEAR(ranges.endpoints_done.high, 99, 1e-9);
  EXPECT_EQ(ranges.open_before, 3);
  c.runs[0].start = c.runs[1].start = Range{1, 9};
  ranges = schedule_ranges(c, model::Writer::of_cyclone);
  EXPECT_EQ(ranges.start.high, 9);
  const auto cyclone = scenario_of(c, {"cyclonedds-0.10", "emulated-ap", {}, {}});
  const auto fastdds = scenario_of(c, {"fastdds-2.6.11", "emulated-ap", {}, {}});
  ASSERT_TRUE(cyclone && fastdds);
  EXPECT_EQ(cyclone->deployment.schedule->open_before, model::Nanoseconds{3'000'000});
  EXPECT_FALSE(fastdds->deployment.schedule->open_before);
}

TEST(Schedule, TheProfileDecidesWhetherThereIsOne) {
  const Configuration c = configuration_of({50}, 2, 4);
  const auto fastdds = scenario_of(c, {"fastdds-2.6.11", "emulated-ap", {}, {}});
  const auto paper = scenario_of(c, {"paper", "emulated-ap", {}, {}});
  const auto asked =
      scenario_of(c, {"paper", "emulated-ap", {"deployment.schedule.start=[0ms,5ms]"}, {}});
  ASSERT_TRUE(fastdds && paper && asked);
  EXPECT_TRUE(fastdds->deployment.schedule);
  EXPECT_FALSE(paper->deployment.schedule);
  EXPECT_TRUE(asked->deployment.schedule);
}

/// Two hosts with one participant each that started at 4 and 30 ms.
Configuration with_times() {
  Configuration c = configuration_of({50}, 1, 20);
  c.runs[0].participants = {{4, 20}, {30, 70}};
  return c;
}

model::Deployment started(const Configuration& c, const ScenarioOptions& options,
                          std::size_t sample) {
  auto scenario = scenario_of(c, options);
  EXPECT_TRUE(scenario);
  start_times(c, *scenario, options).put(scenario->deployment, sample, sample);
  return scenario->deployment;
}

constexpr model::Nanoseconds ms(std::int64_t value) {
  return model::Nanoseconds{value * 1'000'000};
}

TEST(StartTimes, AreThoseOfTheMeasuredRuns) {
  const ScenarioOptions options{"fastdds-2.6.11", "emulated-ap", {}, {}};
  const model::Deployment first = started(with_times(), options, 0);
  EXPECT_EQ(first.participants[0].start, ms(4));
  EXPECT_EQ(first.participants[1].start, ms(30));
  EXPECT_EQ(first.participants[1].endpoints_done, ms(70));
  const model::Deployment again = started(with_times(), options, 1);
  EXPECT_GT(again.participants[1].start, ms(30));
  EXPECT_LE(again.participants[1].start, ms(31));
  EXPECT_EQ(again.participants[1].endpoints_done - again.participants[1].start, ms(40));
}

TEST(StartTimes, OfCycloneItHearsBeforeItsMeasuredStart) {
  const model::Deployment first =
      started(with_times(), {"cyclonedds-0.10", "emulated-ap", {}, {}}, 0);
  EXPECT_EQ(first.participants[1].start, ms(30));
  EXPECT_EQ(first.participants[1].open, ms(27));
}

/// While it creates its endpoints, half of the time, what arrives waits.
TEST(StartTimes, OfCycloneItListensHalfWayToItsLastEndpoint) {
  const model::Participant one =
      started(with_times(), {"cyclonedds-0.10", "emulated-ap", {}, {}}, 0).participants[1];
  EXPECT_EQ(one.ready, ms(50));
  EXPECT_FALSE(
      started(with_times(), {"fastdds-2.6.11", "emulated-ap", {}, {}}, 0).participants[1].ready);
}

TEST(StartTimes, AScheduleThatSomebodyAskedForCounts) {
  const ScenarioOptions options{
      "fastdds-2.6.11", "emulated-ap", {"deployment.schedule.start=[5ms,5ms]"}, {}};
  EXPECT_EQ(started(with_times(), options, 0).participants[1].start, ms(5));
}

TEST(StartTimes, FollowOneAnotherAsPlannedIfNobodyMeasuredThem) {
  Configuration c = configuration_of({50}, 1, 20);
  c.runs[0].start = Range{4, 510};
  c.runs[0].endpoints_done = Range{20, 540};
  c.spread.step_ms = 500;
  const ScenarioOptions options{"fastdds-2.6.11", "emulated-ap", {}, {}};
  EXPECT_EQ(schedule_ranges(c).start.high, 10);
  const model::Deployment one = started(c, options, 0);
  EXPECT_LE(one.participants[0].start, ms(10));
  EXPECT_GE(one.participants[1].start, ms(504));
  EXPECT_LE(one.participants[1].start, ms(510));
}

TEST(StartTimes, ProgramsTakeTimeWhereTheyAreSpread) {
  Configuration c = with_times();
  const auto hosts = [&c](const std::string& dds, const std::vector<std::string>& set) {
    return scenario_of(c, {dds, "emulated-ap", set, {}})->hosts;
  };
  EXPECT_FALSE(hosts("fastdds-2.6.11", {}));
  c.spread.step_ms = 100;
  ASSERT_TRUE(hosts("fastdds-2.6.11", {}));
  EXPECT_EQ(hosts("fastdds-2.6.11", {})->reception.count(), 14'000);
  EXPECT_EQ(hosts("fastdds-2.6.11", {})->deaf_max.count(), 0);
  EXPECT_EQ(hosts("fastdds-2.6.11", {"hosts=raspberry-pi-4"})->cores, 4U);
  EXPECT_FALSE(hosts("paper", {}));
}

TEST(Channel, ADifferenceIsNamed) {
  Configuration c = configuration_of({50});
  const auto scenario = scenario_of(c, {"fastdds-2.6.11", "emulated-ap", {}, {}});
  ASSERT_TRUE(scenario);
  EXPECT_EQ(mismatch(c, *scenario), "");
  c.channel.overhead_unicast_us = 150;
  c.channel.rate_unicast_mbps = 144.4;
  c.channel.send_buffer_bytes = 0;
  c.channel.medium = "ap";
  EXPECT_EQ(mismatch(c, *scenario), "");
  c.channel.send_buffer_bytes = 4'000'000;
  EXPECT_EQ(mismatch(c, *scenario), "sndbuf_B 4000000");
  c.channel.rate_unicast_mbps = 54;
  EXPECT_EQ(mismatch(c, *scenario), "R_u_Mbps 54");
  c.channel.medium = "veth";
  EXPECT_EQ(mismatch(c, *scenario), "medium veth");
}

TEST(Channel, ARowCanBringItsOwn) {
  Configuration c = configuration_of({50});
  c.channel.overhead_unicast_us = 77;
  c.channel.send_buffer_bytes = 4'000'000;
  const auto own = scenario_of(c, {"fastdds-2.6.11", "emulated-ap", {}, ChannelSource::row});
  ASSERT_TRUE(own);
  EXPECT_EQ(own->wireless.overhead_unicast.count(), 77'000);
  EXPECT_EQ(own->dds.sedp.piggyback_threshold_bytes.count(), 4'000'000);
  c.channel.medium = "veth";
  const auto wired = scenario_of(c, {"fastdds-2.6.11", "emulated-ap", {}, ChannelSource::row});
  EXPECT_EQ(wired->wireless.kind, model::ServiceKind::constant_delay);
}

}  // namespace schedule_test
}  // namespace stormproof::prediction
