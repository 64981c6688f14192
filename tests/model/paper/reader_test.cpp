// The reader side: ACKNACKs and their bitmaps, initial ACKNACKs, and what a reader that is not open
// does.
#include <gtest/gtest.h>

#include "tests/model/run_log.hpp"

namespace stormproof::model {
namespace reader_test {

constexpr std::uint64_t all_others = 100'000;

/// Participant 1 recognises 0, and nothing else is ever received.
Scenario only_one_announcement(std::uint32_t publications = 2) {
  Scenario scenario = by_hand({{0, publications}, {1, 0}});
  scenario.time_limit = Nanoseconds{1'500 * ms};
  lose(scenario, 1, all_others);
  return scenario;
}

bool has_initial(const RunLog& log) {
  for (const Sent& packet : log.sent) {
    if (packet.initial_acknack) return true;
  }
  return false;
}

TEST(Reader, InitialAckNacksDoubleTheirDelay) {
  const RunLog log = run_and_log(only_one_announcement());
  const std::vector<std::int64_t> expected{71 * ms, 211 * ms, 491 * ms, 1'051 * ms};
  EXPECT_EQ(log.times_of(PacketKind::acknack, 1, 0, Stream::pub), expected);
  EXPECT_EQ(log.times_of(PacketKind::acknack, 1, 0, Stream::sub), expected);
  for (const Sent& acknack : log.of(PacketKind::acknack, 1, 0)) {
    EXPECT_TRUE(acknack.initial_acknack);
    EXPECT_EQ(acknack.descriptors, (std::vector<std::uint32_t>{0, 1}));
    EXPECT_EQ(acknack.payload_bytes, 64);  // whatever its bitmap
  }
}

TEST(Reader, InitialAckNacksKeepAConstantInterval) {
  Scenario scenario = only_one_announcement();
  scenario.dds.sedp.initial_acknack_interval = InitialAckNackInterval::constant;
  scenario.time_limit = Nanoseconds{420 * ms};
  const RunLog log = run_and_log(scenario);
  const std::vector<std::int64_t> expected{71 * ms, 141 * ms, 211 * ms, 281 * ms, 351 * ms};
  EXPECT_EQ(log.times_of(PacketKind::acknack, 1, 0, Stream::pub), expected);
  EXPECT_EQ(log.times_of(PacketKind::acknack, 1, 0, Stream::sub), expected);
  for (const Sent& acknack : log.of(PacketKind::acknack, 1, 0)) {
    EXPECT_TRUE(acknack.initial_acknack);
  }
}

TEST(Reader, ADelayOfZeroDisablesInitialAckNacks) {
  Scenario scenario = only_one_announcement();
  scenario.dds.sedp.initial_acknack_delay = Nanoseconds{0};
  const RunLog log = run_and_log(scenario);
  EXPECT_TRUE(log.times_of(PacketKind::acknack, 1, 0).empty());
  EXPECT_TRUE(log.scheduled_of(EventKind::initial_acknack_due, 0).empty());
}

TEST(Reader, AHeartbeatInTimeMakesTheInitialAckNackNeedless) {
  Scenario scenario = by_hand({{0, 2}, {1, 0}, {1, 0, 2 * sec}});
  scenario.time_limit = Nanoseconds{sec};
  const RunLog log = run_and_log(scenario);
  EXPECT_FALSE(has_initial(log));
  EXPECT_EQ(log.scheduled_of(EventKind::initial_acknack_due, 0).size(), 1U);
}

TEST(Reader, AHeartbeatAtTheVeryInstantIsInTime) {
  Scenario scenario = by_hand({{0, 2}, {1, 0}, {1, 0, 2 * sec}});
  scenario.time_limit = Nanoseconds{sec};
  scenario.dds.sedp.initial_acknack_delay = Nanoseconds{ms};  // opened at 1 ms, HEARTBEAT at 2 ms
  EXPECT_FALSE(has_initial(run_and_log(scenario)));
  scenario.dds.sedp.initial_acknack_delay = Nanoseconds{ms - 1};
  EXPECT_TRUE(has_initial(run_and_log(scenario)));
}

TEST(Reader, AnAckNackFollowsAHeartbeatAfterTheResponseDelay) {
  Scenario scenario = by_hand({{0, 2}, {1, 0}, {1, 0, 2 * sec}});
  scenario.time_limit = Nanoseconds{sec};
  const RunLog log = run_and_log(scenario);
  const std::vector<Sent> acknacks = log.of(PacketKind::acknack, 1, 0);
  ASSERT_EQ(acknacks.size(), 1U);
  EXPECT_EQ(acknacks[0].time_ns, 2 * ms + 10 * us);
  EXPECT_TRUE(acknacks[0].descriptors.empty());
  EXPECT_EQ(acknacks[0].payload_bytes, 64);
}

TEST(Reader, TheBitmapTakesFourBytesForEvery32DescriptorsOfTheStream) {
  for (const auto& [count, payload] : {std::pair{32U, 68}, std::pair{33U, 72}, std::pair{1U, 68}}) {
    Scenario scenario = by_hand({{0, count}, {1, 0}});
    scenario.dds.sedp.grouping = Grouping::single;
    scenario.dds.spdp.resend = SpdpResend::none;
    lose(scenario, 2, 3);  // the first DATA packet
    const RunLog log = run_and_log(scenario);
    EXPECT_TRUE(log.result.completed());
    const Sent acknack = log.of(PacketKind::acknack, 1, 0).at(0);
    EXPECT_EQ(acknack.descriptors, std::vector<std::uint32_t>{0});
    EXPECT_EQ(acknack.payload_bytes, payload) << count;
  }
}

TEST(Reader, TheBitmapIsThatOfItsGenerationNotOfTheHeartbeat) {
  // A repair that arrives between a HEARTBEAT and its ACKNACK is no longer listed.
  Scenario scenario = by_hand({{0, 1}, {1, 0}, {1, 0, 9 * sec}});
  scenario.dds.spdp.resend = SpdpResend::none;
  scenario.dds.sedp.heartbeat_response_delay = Nanoseconds{100 * ms};
  scenario.dds.sedp.heartbeat_period = Nanoseconds{102 * ms};  // second HEARTBEAT: sent at 103 ms
  scenario.time_limit = Nanoseconds{300 * ms};
  const RunLog first = run_and_log(scenario);
  const std::uint64_t data = first.of(PacketKind::data, 0, 1).at(0).number;
  lose(scenario, data, data + 1);
  const RunLog log = run_and_log(scenario);
  const std::vector<Sent> acknacks = log.of(PacketKind::acknack, 1, 0);
  ASSERT_GE(acknacks.size(), 2U);
  EXPECT_EQ(acknacks[0].time_ns, 102 * ms);  // the first HEARTBEAT, at 2 ms
  EXPECT_EQ(acknacks[0].descriptors.size(), 1U);
  // The repair leaves at 103.1 ms and arrives at 104.1 ms; the second HEARTBEAT arrives at 104 ms.
  EXPECT_EQ(log.of(PacketKind::data, 0, 1).at(1).time_ns, 103 * ms + 100 * us);
  EXPECT_EQ(acknacks[1].time_ns, 204 * ms);
  EXPECT_TRUE(acknacks[1].descriptors.empty());
}

/// 0 recognises 1 at 1 ms and sends its DATA; 1 recognises 0 only at 101 ms.
Scenario data_before_recognition(Unmatched unmatched) {
  Scenario scenario = by_hand({{0, 2}, {1, 1}});
  scenario.dds.sedp.relation_opening = RelationOpening::each_side;
  scenario.dds.sedp.unmatched = unmatched;
  scenario.dds.spdp.resend = SpdpResend::none;
  lose(scenario, 0, 1);
  return scenario;
}

TEST(Reader, ANotYetOpenReaderDropsDataAndHeartbeats) {
  const RunLog log = run_and_log(data_before_recognition(Unmatched::drop));
  // At 101 ms the reader opens, at 171 ms it asks by itself, at 172.1 ms comes the repair.
  EXPECT_EQ(log.times_of(PacketKind::acknack, 1, 0), std::vector<std::int64_t>{171 * ms});
  EXPECT_EQ(log.result.discovery_time, Nanoseconds{173 * ms + 100 * us});
  EXPECT_EQ(log.result.counts.repair_data, 2U);
}

TEST(Reader, ANotYetOpenReaderMayAcceptThem) {
  const RunLog log = run_and_log(data_before_recognition(Unmatched::accept));
  EXPECT_EQ(log.times_of(PacketKind::acknack, 1, 0), std::vector<std::int64_t>{2 * ms + 10 * us});
  EXPECT_EQ(log.result.discovery_time, Nanoseconds{102 * ms});  // the other direction
  EXPECT_EQ(log.result.counts.repair_data, 0U);
}

TEST(Reader, TheLastDescriptorEndsTheRunBeforeTheHeartbeatOfItsPacket) {
  Scenario scenario = by_hand({{0, 3}, {1, 0}});
  scenario.dds.sedp.piggyback = Piggyback::linear;
  scenario.dds.sedp.piggyback_threshold_bytes = Bytes{1};
  const RunLog log = run_and_log(scenario);
  EXPECT_TRUE(log.of(PacketKind::data, 0, 1).at(0).carries_heartbeat);
  EXPECT_EQ(log.result.discovery_time, Nanoseconds{2 * ms});
  EXPECT_TRUE(log.scheduled_of(EventKind::acknack_generation, 0).empty());
}

TEST(Reader, APacketWithSeveralHeartbeatsIsAnsweredOnce) {
  Scenario scenario = by_hand({{0, 3}, {1, 0}, {1, 0, sec}});
  scenario.dds.sedp.piggyback = Piggyback::linear;
  scenario.dds.sedp.piggyback_threshold_bytes = Bytes{1};
  scenario.time_limit = Nanoseconds{50 * ms};
  const RunLog log = run_and_log(scenario);
  EXPECT_EQ(log.of(PacketKind::data, 0, 1).at(0).payload_bytes, 460 + 2 * 424 + 3 * 32);
  // One for the DATA packet, one for the HEARTBEAT of the opening.
  EXPECT_EQ(log.of(PacketKind::acknack, 1, 0).size(), 2U);
}

}  // namespace reader_test
}  // namespace stormproof::model
