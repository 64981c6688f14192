// The writer side: what an ACKNACK sets off, to the nanosecond, and when it is ignored.
#include <algorithm>

#include <gtest/gtest.h>

#include "tests/model/run_log.hpp"

namespace stormproof::model {
namespace writer_test {

/// 0 has `publications`, 1 has none; packet 2 is the first DATA packet, and it is lost.
Scenario first_data_lost(std::uint32_t publications) {
  Scenario scenario = by_hand({{0, publications}, {1, 0}});
  scenario.dds.spdp.resend = SpdpResend::none;
  lose(scenario, 2, 3);
  return scenario;
}

bool happened(const RunLog& log, const std::string& transition) {
  return std::find(log.transitions.begin(), log.transitions.end(), transition) !=
         log.transitions.end();
}

TEST(Writer, ALostDataPacketIsRepairedStepByStep) {
  const RunLog log = run_and_log(first_data_lost(2));
  // HEARTBEAT at 2 ms, ACKNACK 10 us later, 1 ms on its way, 100 us of preparation, 1 ms on its
  // way.
  EXPECT_EQ(log.result.discovery_time, Nanoseconds{4 * ms + 110 * us});
  EXPECT_EQ(log.result.counts.initial_data, 2U);
  EXPECT_EQ(log.result.counts.repair_data, 2U);
  const std::vector<Sent> data = log.of(PacketKind::data, 0, 1);
  ASSERT_EQ(data.size(), 2U);
  EXPECT_EQ(data[1].time_ns, 3 * ms + 110 * us);
  EXPECT_TRUE(data[1].from_repair);
  EXPECT_EQ(data[1].descriptors, (std::vector<std::uint32_t>{0, 1}));
  const auto ends = log.scheduled_of(EventKind::suppression_end, 0);
  ASSERT_EQ(ends.size(), 1U);
  EXPECT_EQ(ends[0].at_ns, 3 * ms + 110 * us);
  EXPECT_EQ(ends[0].due_ns, 3 * ms + 120 * us);
}

TEST(Writer, ALostRepairWaitsForTheNextHeartbeat) {
  Scenario scenario = first_data_lost(2);
  const std::uint64_t repair = run_and_log(scenario).of(PacketKind::data, 0, 1).at(1).number;
  lose(scenario, repair, repair + 1);
  const RunLog log = run_and_log(scenario);
  EXPECT_EQ(log.result.discovery_time, Nanoseconds{sec + 4 * ms + 110 * us});
  EXPECT_EQ(log.result.counts.repair_data, 4U);
  EXPECT_TRUE(happened(log, "DescriptorRepair 0: S + SuppressionEnded -> U"));
}

TEST(Writer, OnlyWhatIsListedIsRepaired) {
  Scenario scenario = first_data_lost(3);
  scenario.dds.sedp.grouping = Grouping::single;
  const RunLog log = run_and_log(scenario);
  EXPECT_EQ(log.result.counts.repair_data, 1U);
  EXPECT_EQ(log.of(PacketKind::data, 0, 1).at(3).descriptors, std::vector<std::uint32_t>{0});
}

TEST(Writer, WhatAnAckNackConfirmsDependsOnTheProfile) {
  const std::string confirmed = "DescriptorRepair 0: U + AckNackReceived -> A";
  Scenario scenario = first_data_lost(3);
  scenario.dds.sedp.grouping = Grouping::single;
  EXPECT_TRUE(happened(run_and_log(scenario), confirmed));
  scenario.dds.sedp.acknowledge = Acknowledge::prefix;
  EXPECT_FALSE(happened(run_and_log(scenario), confirmed));  // 1 and 2 are above the missing 0
}

TEST(Writer, SuppressionIgnoresRequestsUntilItEnds) {
  // A HEARTBEAT every 101 us, so requests come at 3.010, 3.111, 3.212 ms. The repair leaves
  // at 3.110 ms.
  struct Case {
    std::int64_t suppression_ns;
    std::int64_t second_repair_ns;
  };
  for (const Case& c : {Case{us - 1, 3'211 * us},  // over just before the second request
                        Case{us, 3'312 * us},      // ends at 3.111 ms, but receptions come first
                        Case{2 * us, 3'312 * us}}) {
    Scenario scenario = by_hand({{0, 2}, {1, 0}, {1, 0, 5 * sec}});
    scenario.dds.spdp.resend = SpdpResend::none;
    scenario.dds.sedp.heartbeat_period = Nanoseconds{101 * us};
    scenario.dds.sedp.nack_suppression_duration = Nanoseconds{c.suppression_ns};
    scenario.time_limit = Nanoseconds{5 * ms};
    lose(scenario, 2, 3);
    const std::vector<std::int64_t> times = run_and_log(scenario).times_of(PacketKind::data, 0, 1);
    ASSERT_GE(times.size(), 3U);
    EXPECT_EQ(times[1], 3'110 * us);
    EXPECT_EQ(times[2], c.second_repair_ns) << c.suppression_ns;
  }
}

/// With pull and without the HEARTBEAT of the opening, everything waits for the initial ACKNACK at
/// 71 ms.
RunLog initial_acknack_answered_by(InitialAckNackReply reply) {
  Scenario scenario = by_hand({{0, 2}, {1, 0}});
  scenario.dds.spdp.resend = SpdpResend::none;
  scenario.dds.sedp.initial_data = InitialData::pull;
  scenario.dds.sedp.initial_acknack = reply;
  lose(scenario, 2, 3);
  return run_and_log(scenario);
}

TEST(Writer, AnInitialAckNackIsAnOrdinaryRequest) {
  const RunLog log = initial_acknack_answered_by(InitialAckNackReply::bitmap);
  EXPECT_EQ(log.result.discovery_time, Nanoseconds{73 * ms + 100 * us});
  EXPECT_EQ(log.result.counts.initial_data, 2U);  // for the first time, though on request
  EXPECT_EQ(log.result.counts.repair_data, 0U);
}

TEST(Writer, AnInitialAckNackMayBeAnsweredByAHeartbeat) {
  const RunLog log = initial_acknack_answered_by(InitialAckNackReply::heartbeat);
  EXPECT_EQ(log.times_of(PacketKind::heartbeat, 0, 1), (std::vector<std::int64_t>{ms, 72 * ms}));
  EXPECT_EQ(log.result.discovery_time, Nanoseconds{75 * ms + 110 * us});
}

TEST(Writer, AnInitialAckNackMayBeIgnored) {
  const RunLog log = initial_acknack_answered_by(InitialAckNackReply::none);
  EXPECT_EQ(log.times_of(PacketKind::heartbeat, 0, 1), (std::vector<std::int64_t>{ms, sec + ms}));
  EXPECT_EQ(log.result.discovery_time, Nanoseconds{sec + 4 * ms + 110 * us});
}

TEST(Writer, AWriterThatIsNotOpenIgnoresAckNacks) {
  // 1 recognises 0 at 1 ms and asks at 71 ms; 0 recognises 1 at 101 ms only.
  Scenario scenario = by_hand({{0, 2}, {1, 0}});
  scenario.dds.sedp.relation_opening = RelationOpening::each_side;
  scenario.dds.spdp.resend = SpdpResend::none;
  lose(scenario, 1, 2);
  const RunLog log = run_and_log(scenario);
  EXPECT_EQ(log.times_of(PacketKind::acknack, 1, 0), std::vector<std::int64_t>{71 * ms});
  EXPECT_EQ(log.times_of(PacketKind::data, 0, 1), std::vector<std::int64_t>{101 * ms});
  EXPECT_EQ(log.result.discovery_time, Nanoseconds{102 * ms});
  EXPECT_EQ(log.result.counts.repair_data, 0U);
}

}  // namespace writer_test
}  // namespace stormproof::model
