// The reader side: what it knows to exist, what it asks for, and what it drops.
#include <gtest/gtest.h>

#include "tests/model/fastdds/fastdds_run.hpp"

namespace stormproof::model::fastdds {
namespace reader_test {

using Kind = PacketKind;
constexpr std::uint64_t all_others = 100'000;

/// pub0, pub1 and pub2 are pushed at 10, 30 and 50 ms, and those that are listed here are lost. The
/// HEARTBEAT of the opening announces nothing and is answered at 52 ms.
Emission acknack_after_losing(const std::vector<std::uint32_t>& lost) {
  Scenario scenario = one_writer(10 * ms);
  scenario.dds.sedp.heartbeat_response_delay = Nanoseconds{50 * ms};
  scenario.time_limit = Nanoseconds{53 * ms};
  const FastddsLog first = run(scenario);
  for (const std::uint32_t d : lost) {
    scenario.wireless.lost_packets.push_back(first.number_of_data(0, 1, d));
  }
  const std::vector<Emission> acknacks = run(scenario).of(Kind::acknack, 1, 0);
  EXPECT_EQ(acknacks.size(), 1U);
  EXPECT_EQ(acknacks.at(0).time_ns, 52 * ms);
  return acknacks.at(0);
}

TEST(FastddsReader, ANackAsksOnlyForWhatWasAnnounced) {
  const Emission nothing_known = acknack_after_losing({0, 1, 2});
  EXPECT_EQ(nothing_known.detail, 0U);
  EXPECT_TRUE(nothing_known.descriptors.empty());  // three of them exist
  EXPECT_EQ(nothing_known.bytes, 64);
}

TEST(FastddsReader, DataAnnouncesAllThatComesBeforeIt) {
  const Emission acknack = acknack_after_losing({0, 1});
  EXPECT_EQ(acknack.detail, 0U);
  EXPECT_EQ(acknack.descriptors, (Numbers{0, 1}));
  EXPECT_EQ(acknack.bytes, 68);
}

TEST(FastddsReader, TheBaseIsTheFirstMissingDescriptor) {
  EXPECT_EQ(acknack_after_losing({}).detail, 3U);
  EXPECT_EQ(acknack_after_losing({2}).detail, 2U);
  EXPECT_TRUE(acknack_after_losing({2}).descriptors.empty());  // unknown to the reader
  const Emission hole = acknack_after_losing({1});
  EXPECT_EQ(hole.detail, 1U);
  EXPECT_EQ(hole.descriptors, Numbers{1});
}

TEST(FastddsReader, AnInitialAckNackClaimsNothing) {
  Scenario scenario = one_writer(0);
  scenario.time_limit = Nanoseconds{600 * ms};
  lose(scenario, 2, all_others);  // after both announcements nothing arrives
  const FastddsLog log = run(scenario);
  EXPECT_EQ(log.times_of(Kind::acknack, 1, 0), (Times{71 * ms, 211 * ms, 491 * ms}));
  for (const Emission& acknack : log.of(Kind::acknack, 1, 0)) {
    EXPECT_TRUE(acknack.initial);
    EXPECT_EQ(acknack.detail, 0U);
    EXPECT_TRUE(acknack.descriptors.empty());
    EXPECT_EQ(acknack.bytes, 64);
  }
}

TEST(FastddsReader, InitialAckNacksKeepAConstantInterval) {
  Scenario scenario = one_writer(0);
  scenario.dds.sedp.initial_acknack_interval = InitialAckNackInterval::constant;
  scenario.time_limit = Nanoseconds{400 * ms};
  lose(scenario, 2, all_others);  // after both announcements nothing arrives
  const FastddsLog log = run(scenario);
  EXPECT_EQ(log.times_of(Kind::acknack, 1, 0),
            (Times{71 * ms, 141 * ms, 211 * ms, 281 * ms, 351 * ms}));
  for (const Emission& acknack : log.of(Kind::acknack, 1, 0)) EXPECT_TRUE(acknack.initial);
}

TEST(FastddsReader, AHeartbeatEndsInitialAckNacksOfAConstantInterval) {
  Scenario scenario = one_writer(0);
  scenario.dds.sedp.initial_acknack_interval = InitialAckNackInterval::constant;
  scenario.time_limit = Nanoseconds{1'500 * ms};
  lose(scenario, 2, 30);  // what is sent later arrives
  Times initial;
  for (const Emission& acknack : run(scenario).of(Kind::acknack, 1, 0)) {
    if (acknack.initial) initial.push_back(acknack.time_ns);
  }
  ASSERT_GE(initial.size(), 2U);
  for (std::size_t k = 0; k < initial.size(); ++k) {
    EXPECT_EQ(initial[k], ms + 70 * ms * static_cast<std::int64_t>(k + 1));
  }
  EXPECT_LT(initial.back(), 1'000 * ms);
}

TEST(FastddsReader, AHeartbeatEndsTheInitialAckNacks) {
  Scenario scenario = one_writer(sec);
  scenario.time_limit = Nanoseconds{500 * ms};
  for (const Emission& acknack : run(scenario).of(Kind::acknack, 1, 0)) {
    EXPECT_FALSE(acknack.initial);
  }
}

TEST(FastddsReader, HeartbeatsWithinTheDelayShareAnAckNackAtTheTimeOfTheFirst) {
  Scenario scenario = one_writer(0);
  scenario.dds.sedp.heartbeat_period = Nanoseconds{3 * ms};
  scenario.dds.sedp.heartbeat_response_delay = Nanoseconds{10 * ms};
  scenario.time_limit = Nanoseconds{20 * ms};
  const FastddsLog log = run(scenario);
  // HEARTBEATs arrive at 2, 5, 8, 11 and 14 ms.
  const Times expected{ms, 4 * ms, 7 * ms, 10 * ms, 13 * ms};
  const Times times = log.times_of(Kind::heartbeat, 0, 1);
  ASSERT_GE(times.size(), 5U);
  EXPECT_EQ(Times(times.begin(), times.begin() + 5), expected);
  EXPECT_EQ(log.times_of(Kind::acknack, 1, 0), Times{12 * ms});
}

TEST(FastddsReader, AHeartbeatThatRidesIsProcessedAfterItsData) {
  Scenario scenario = one_writer(10 * ms);
  scenario.dds.sedp.piggyback = Piggyback::linear;
  scenario.dds.sedp.piggyback_threshold_bytes = Bytes{1};
  scenario.time_limit = Nanoseconds{15 * ms};
  const std::vector<Emission> acknacks = run(scenario).of(Kind::acknack, 1, 0);
  ASSERT_EQ(acknacks.size(), 2U);
  EXPECT_EQ(acknacks[1].time_ns, 11 * ms + 10 * us);
  EXPECT_EQ(acknacks[1].detail, 1U);  // pub0 has been taken
}

TEST(FastddsReader, AClosedReaderSideDropsDataAndHeartbeats) {
  // 0 recognises 1 at 1 ms and pushes pub0 at 10 ms; 1 recognises 0 at 101 ms only.
  Scenario scenario = one_writer(10 * ms);
  lose(scenario, 0, 1);
  scenario.time_limit = Nanoseconds{400 * ms};
  const FastddsLog log = run(scenario);
  EXPECT_EQ(log.times_of(Kind::heartbeat, 0, 1), (Times{ms, 172 * ms}));
  const std::vector<Emission> acknacks = log.of(Kind::acknack, 1, 0);
  ASSERT_GE(acknacks.size(), 2U);
  EXPECT_TRUE(acknacks[0].initial);
  EXPECT_EQ(acknacks[0].time_ns, 171 * ms);  // it has seen no HEARTBEAT
  EXPECT_EQ(acknacks[1].detail, 0U);
  // pub0 … pub4 were pushed by 90 ms and dropped; pub5 … pub8 came after 101 ms.
  EXPECT_EQ(acknacks[1].descriptors, (Numbers{0, 1, 2, 3, 4}));
  EXPECT_EQ(log.result.counts.repair_data, 5U + 4U + 1U);  // sub0 … sub3 at 20 … 80 ms, sub4
}

TEST(FastddsReader, TheLastDescriptorEndsTheRunBeforeTheHeartbeatOfItsPacket) {
  Scenario scenario = fastdds_by_hand({{.host = 0}, {.host = 1}});
  scenario.dds.sedp.piggyback = Piggyback::linear;
  scenario.dds.sedp.piggyback_threshold_bytes = Bytes{1};
  const FastddsLog log = run(scenario);
  EXPECT_EQ(log.result.discovery_time, Nanoseconds{4'110 * us});
  // Every DATA packet carries HEARTBEATs; 0's subscriptions arrive last and end the run.
  EXPECT_EQ(log.timers(EventKind::acknack_generation, 0).size(), 2U);
  EXPECT_EQ(log.timers(EventKind::acknack_generation, 3).size(), 2U);
  EXPECT_EQ(log.of(Kind::data, 0, 1, Stream::sub).at(0).heartbeats, 8U);
  EXPECT_EQ(log.timers(EventKind::acknack_generation, 1).size(), 1U);
}

TEST(FastddsReader, ADuplicateIsCountedAndChangesNothing) {
  Scenario scenario = one_writer(0);
  scenario.dds.sedp.heartbeat_period = Nanoseconds{990 * us};
  scenario.time_limit = Nanoseconds{6 * ms};
  const FastddsLog log = run(scenario);
  // Sent at 3.11, 4.1 and 5.09 ms, because the first one arrives at 4.11 ms; the third is on its
  // way.
  EXPECT_EQ(log.of(Kind::data, 0, 1).size(), 3U);
  EXPECT_EQ(log.result.useful_deliveries, 17U);
  EXPECT_EQ(log.result.duplicate_deliveries, 17U);
}

}  // namespace reader_test
}  // namespace stormproof::model::fastdds
