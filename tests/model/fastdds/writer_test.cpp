// The writer side, to the nanosecond: who gets a HEARTBEAT when and of which size, what an ACKNACK
// sets off, suppression, and what fills the piggyback budget again.
#include <algorithm>

#include <gtest/gtest.h>

#include "tests/model/fastdds/fastdds_run.hpp"

namespace stormproof::model::fastdds {
namespace writer_test {

using Kind = PacketKind;
using Timers = std::vector<std::pair<std::int64_t, std::int64_t>>;
constexpr std::uint32_t pub_writer_of_0 = 0;
constexpr std::uint32_t relation_0_to_1 = 0;  // of the publications

Timers expiries(const FastddsLog& log) {
  return log.timers(EventKind::heartbeat_expiry, pub_writer_of_0);
}

Scenario until(Scenario scenario, std::int64_t limit_ns) {
  scenario.time_limit = Nanoseconds{limit_ns};
  return scenario;
}

TEST(FastddsWriter, ExistingDescriptorsArePulledAndLaterOnesArePushed) {
  // pub0, sub0, pub1, … are created every 400 us; the announcement is recognised at 1 ms.
  const FastddsLog log = run(until(one_writer(400 * us), 6 * ms));
  const std::vector<Emission> data = log.of(Kind::data, 0, 1);
  ASSERT_GE(data.size(), 6U);
  EXPECT_EQ(data[0].time_ns, 1'200 * us);  // pub1, the third endpoint: pushed
  EXPECT_EQ(data[0].descriptors, Numbers{1});
  EXPECT_EQ(data[1].time_ns, 2'000 * us);      // pub2
  EXPECT_EQ(data[2].time_ns, 2'800 * us);      // pub3
  EXPECT_EQ(data[3].descriptors, Numbers{0});  // asked for: HEARTBEAT, 10 us, ACKNACK, 100 us
  EXPECT_EQ(data[3].time_ns, 3'110 * us);
  EXPECT_EQ(data[4].descriptors, Numbers{4});
  for (const Emission& packet : data) EXPECT_EQ(packet.descriptors.size(), 1U);
}

TEST(FastddsWriter, TheHeartbeatOfTheOpeningAnnouncesWhatExistsThen) {
  const FastddsLog none = run(until(one_writer(10 * ms), 5 * ms));
  ASSERT_EQ(none.of(Kind::heartbeat, 0, 1).size(), 1U);
  EXPECT_EQ(none.of(Kind::heartbeat, 0, 1)[0].detail, 0U);
  EXPECT_TRUE(expiries(none).empty());  // there is nothing to check
  const FastddsLog nine = run(until(one_writer(0), 5 * ms));
  ASSERT_EQ(nine.of(Kind::heartbeat, 0, 1).size(), 1U);
  EXPECT_EQ(nine.of(Kind::heartbeat, 0, 1)[0].detail, 9U);
  EXPECT_EQ(nine.of(Kind::heartbeat, 0, 1)[0].bytes, 68);
  EXPECT_EQ(expiries(nine), (Timers{{ms, sec + ms}}));
}

TEST(FastddsWriter, APeriodicHeartbeatHas68BytesToOneReaderAnd52ToSeveral) {
  for (const auto& [readers, bytes] : {std::pair{1U, 68}, std::pair{2U, 52}}) {
    const FastddsLog log = run(until(one_writer(0, readers), 1'001 * ms));
    for (std::uint32_t j = 1; j <= readers; ++j) {
      const std::vector<Emission> heartbeats = log.of(Kind::heartbeat, 0, j);
      ASSERT_EQ(heartbeats.size(), 2U);
      EXPECT_EQ(heartbeats[0].bytes, 68);  // of the opening
      EXPECT_EQ(heartbeats[1].time_ns, 1'001 * ms);
      EXPECT_EQ(heartbeats[1].bytes, bytes);
    }
  }
}

TEST(FastddsWriter, ASameHostReaderMakesAPeriodicHeartbeatSmallerButIsNotCounted) {
  Scenario scenario = fastdds_by_hand({{.host = 0}, {.host = 1}, {.host = 0}});
  for (const std::size_t quiet : {1U, 2U}) {
    scenario.deployment.participants[quiet].endpoints_done = Nanoseconds{100'000 * sec};
  }
  const FastddsLog log = run(until(scenario, 1'001 * ms));
  EXPECT_EQ(log.of(Kind::heartbeat, 0, 1).at(1).bytes, 52);
  EXPECT_EQ(log.of(Kind::heartbeat, 0, 2).at(1).bytes, 52);
  EXPECT_TRUE(log.of(Kind::heartbeat, 0, 2).at(1).looped);
  std::uint64_t cross_host = 0;
  for (const Emission& packet : log.sent) {
    if (packet.kind == Kind::heartbeat && !packet.looped) ++cross_host;
  }
  EXPECT_EQ(log.result.counts.heartbeat, cross_host);
}

TEST(FastddsWriter, OneReaderThatIsBehindBringsAHeartbeatToAll) {
  Scenario scenario = until(one_writer(0, 2), 3 * sec);
  // The first periodic HEARTBEAT (1.001 s) gets an ACKNACK of 1, but is lost on its way to 2.
  const std::uint64_t lost = run(scenario).of(Kind::heartbeat, 0, 2).at(1).number;
  lose(scenario, lost, lost + 1);
  const FastddsLog log = run(scenario);
  const Times expected{ms, sec + ms, 2 * sec + ms};
  EXPECT_EQ(log.times_of(Kind::heartbeat, 0, 1), expected);  // though 1 has acknowledged everything
  EXPECT_EQ(log.times_of(Kind::heartbeat, 0, 2), expected);
}

TEST(FastddsWriter, ALostPushIsRepairedAfterTheNextExpiry) {
  Scenario scenario = until(one_writer(10 * ms), 2 * sec);
  const std::uint64_t lost = run(scenario).number_of_data(0, 1, 1);
  lose(scenario, lost, lost + 1);
  const FastddsLog log = run(scenario);
  // pub0 is pushed at 10 ms, which arms the timer; HEARTBEAT at 1.01 s, ACKNACK, nack response.
  EXPECT_EQ(log.times_of(Kind::heartbeat, 0, 1), (Times{ms, sec + 10 * ms}));
  const std::vector<Emission> data = log.of(Kind::data, 0, 1);
  ASSERT_EQ(data.size(), 10U);
  EXPECT_EQ(data[9].descriptors, Numbers{1});
  EXPECT_EQ(data[9].time_ns, sec + 12 * ms + 110 * us);
  EXPECT_EQ(log.result.counts.initial_data, 17U);
  EXPECT_EQ(log.result.counts.repair_data, 1U);
}

TEST(FastddsWriter, AClosedWriterSideIgnoresAckNacks) {
  Scenario scenario = fastdds_by_hand({{.host = 0}, {.host = 1}});
  lose(scenario, 1, 2);  // 1's first announcement: 0 recognises it at 101 ms
  const FastddsLog log = run(until(scenario, 110 * ms));
  const std::vector<Emission> acknacks = log.of(Kind::acknack, 1, 0);
  ASSERT_GE(acknacks.size(), 1U);
  EXPECT_TRUE(acknacks[0].initial);
  EXPECT_EQ(acknacks[0].time_ns, 71 * ms);
  EXPECT_EQ(log.times_of(Kind::heartbeat, 0, 1), Times{101 * ms});  // none at 72 ms
}

/// Nothing exists at the match, and the HEARTBEAT of the opening is lost: 1 asks by itself.
Scenario opening_lost(std::int64_t step_ns) {
  Scenario scenario = one_writer(step_ns);
  scenario.time_limit = Nanoseconds{200 * ms};
  const std::uint64_t lost = run(scenario).of(Kind::heartbeat, 0, 1).at(0).number;
  lose(scenario, lost, lost + 1);
  return scenario;
}

TEST(FastddsWriter, AnInitialAckNackIsAnsweredByAHeartbeatAndArmsTheTimer) {
  const FastddsLog log = run(opening_lost(sec));
  EXPECT_EQ(log.times_of(Kind::acknack, 1, 0).at(0), 71 * ms);
  const std::vector<Emission> heartbeats = log.of(Kind::heartbeat, 0, 1);
  ASSERT_EQ(heartbeats.size(), 2U);
  EXPECT_EQ(heartbeats[1].time_ns, 72 * ms);
  EXPECT_EQ(heartbeats[1].bytes, 68);
  EXPECT_EQ(expiries(log), (Timers{{72 * ms, sec + 72 * ms}}));
  EXPECT_TRUE(log.of(Kind::data, 0, 1).empty());
}

TEST(FastddsWriter, AnyHeartbeatFillsThePiggybackBudgetAgain) {
  // Pushes every 40 ms from 20 ms on are charged 444, 416, 460, 468, 460 bytes.
  Scenario scenario = opening_lost(20 * ms);
  scenario.dds.sedp.piggyback = Piggyback::linear;
  scenario.dds.sedp.piggyback_threshold_bytes = Bytes{1'000};
  scenario.time_limit = Nanoseconds{185 * ms};
  const auto first_with_heartbeat = [](const FastddsLog& log) {
    for (const Emission& packet : log.of(Kind::data, 0, 1)) {
      if (packet.heartbeats > 0) return packet.descriptors.at(0);
    }
    return everybody;
  };
  const FastddsLog log = run(scenario);
  EXPECT_EQ(first_with_heartbeat(log), 4U);  // the answer to the initial ACKNACK came before pub2
  const std::uint64_t acknack = log.of(Kind::acknack, 1, 0).at(0).number;
  lose(scenario, acknack, acknack + 1);
  std::sort(scenario.wireless.lost_packets.begin(), scenario.wireless.lost_packets.end());
  EXPECT_EQ(first_with_heartbeat(run(scenario)), 2U);
}

TEST(FastddsWriter, ANackThatRequestsNothingNewArmsTheTimer) {
  Scenario scenario = one_writer(100 * ms);
  scenario.dds.sedp.heartbeat_period = Nanoseconds{17 * ms};
  scenario.dds.sedp.heartbeat_response_delay = Nanoseconds{50 * ms};
  scenario.dds.sedp.nack_response_delay = Nanoseconds{100 * ms};
  scenario.time_limit = Nanoseconds{450 * ms};
  const std::uint64_t lost = run(scenario).number_of_data(0, 1, 1);
  lose(scenario, lost, lost + 1);  // pub1, pushed at 300 ms
  const FastddsLog log = run(scenario);
  // HEARTBEATs at 317, 334, 351 and 368 ms. The first three are answered at 368 ms: pub1 is
  // requested, so the expiry of 385 ms sends nothing and the timer rests. The fourth is answered
  // at 419 ms; pub1 is requested still.
  const Times expected{ms,       117 * ms, 134 * ms, 151 * ms, 168 * ms,
                       317 * ms, 334 * ms, 351 * ms, 368 * ms};
  EXPECT_EQ(log.times_of(Kind::heartbeat, 0, 1), expected);
  const std::vector<Emission> acknacks = log.of(Kind::acknack, 1, 0);
  ASSERT_GE(acknacks.size(), 2U);
  EXPECT_EQ(acknacks.back().time_ns, 419 * ms);
  EXPECT_EQ(acknacks.back().descriptors, Numbers{1});
  const Timers timers = expiries(log);
  ASSERT_GE(timers.size(), 2U);
  EXPECT_EQ(timers[timers.size() - 2], std::pair(368 * ms, 385 * ms));
  EXPECT_EQ(timers.back(), std::pair(420 * ms, 437 * ms));
  EXPECT_EQ(log.timers(EventKind::nack_response, pub_writer_of_0),
            (Timers{{369 * ms, 469 * ms}}));  // the second request adds none
}

TEST(FastddsWriter, ACleanAckNackArmsNothing) {
  Scenario scenario = one_writer(100 * ms);
  scenario.dds.sedp.heartbeat_period = Nanoseconds{17 * ms};
  const FastddsLog log = run(until(scenario, 290 * ms));
  // Push at 100 ms, expiry and HEARTBEAT at 117 ms, clean ACKNACK at 119.01 ms, expiry at 134 ms.
  EXPECT_EQ(log.times_of(Kind::acknack, 1, 0), (Times{2 * ms + 10 * us, 118 * ms + 10 * us}));
  EXPECT_EQ(expiries(log), (Timers{{100 * ms, 117 * ms}, {117 * ms, 134 * ms}}));
}

TEST(FastddsWriter, ARelationHasOneSuppressionEndForAllItsDescriptors) {
  Scenario scenario = one_writer(100 * ms);
  scenario.dds.sedp.nack_suppression_duration = Nanoseconds{250 * ms};
  scenario.dds.sedp.heartbeat_period = Nanoseconds{10 * sec};
  const FastddsLog log = run(until(scenario, 600 * ms));
  // pub0, pub1 and pub2 are pushed at 100, 300 and 500 ms.
  EXPECT_EQ(log.timers(EventKind::suppression_end, relation_0_to_1),
            (Timers{{100 * ms, 350 * ms}, {500 * ms, 750 * ms}}));
  const std::vector<Move> ends = log.moves_of("ChangeForReader 0: S + SuppressionEnded -> U");
  ASSERT_EQ(ends.size(), 1U);
  EXPECT_EQ(ends[0].time_ns, 350 * ms);
  EXPECT_EQ(ends[0].descriptors, (Numbers{0, 1}));
}

TEST(FastddsWriter, TheEndOfASuppressionArmsTheTimerEvenIfNothingIsSuppressed) {
  Scenario scenario = one_writer(100 * ms);
  scenario.dds.sedp.nack_suppression_duration = Nanoseconds{150 * ms};
  scenario.dds.sedp.heartbeat_period = Nanoseconds{17 * ms};
  const FastddsLog log = run(until(scenario, 290 * ms));
  EXPECT_TRUE(log.moves_of("ChangeForReader 0: S + SuppressionEnded -> U").empty());
  EXPECT_EQ(expiries(log).back(), std::pair(250 * ms, 267 * ms));
  EXPECT_EQ(log.times_of(Kind::heartbeat, 0, 1), (Times{ms, 117 * ms}));  // no reason to send
}

TEST(FastddsWriter, WhatIsSuppressedIsAcknowledgedAndNotRequested) {
  Scenario scenario = one_writer(0);
  scenario.dds.sedp.nack_suppression_duration = Nanoseconds{500 * us};
  scenario.dds.sedp.heartbeat_period = Nanoseconds{2'200 * us};
  scenario.time_limit = Nanoseconds{10 * ms};
  const FastddsLog log = run(scenario);
  // The DATA leaves at 3.11 ms; the HEARTBEAT of 3.2 ms is answered cleanly; in U after 3.61 ms.
  EXPECT_EQ(log.times_of(Kind::data, 0, 1), Times{3'110 * us});
  EXPECT_EQ(log.moves_of("ChangeForReader 0: U + AckNackReceived -> A").size(), 1U);
  EXPECT_EQ(log.of(Kind::acknack, 1, 0).back().detail, 9U);
  EXPECT_EQ(log.of(Kind::acknack, 1, 0).back().bytes, 64);
}

TEST(FastddsWriter, ASecondNackRepairsWhatIsStillOnItsWayOnceSuppressionIsOver) {
  struct Case {
    std::int64_t suppression_ns;
    std::size_t messages;
  };
  for (const Case& c : {Case{10 * us, 2}, Case{10 * ms, 1}}) {
    Scenario scenario = one_writer(0);
    scenario.dds.sedp.nack_suppression_duration = Nanoseconds{c.suppression_ns};
    scenario.dds.sedp.heartbeat_period = Nanoseconds{990 * us};
    scenario.time_limit = Nanoseconds{5 * ms};
    // HEARTBEATs at 1 and 1.99 ms, so requests arrive at 3.01 and 4 ms. The first one is served at
    // 3.11 ms, the second one lists everything, because the DATA arrives at 4.11 ms only.
    const FastddsLog log = run(scenario);
    EXPECT_EQ(log.of(Kind::acknack, 1, 0).at(1).descriptors.size(), 9U);
    EXPECT_EQ(log.of(Kind::data, 0, 1).size(), c.messages);
    EXPECT_EQ(log.result.counts.repair_data, c.messages == 2 ? 9U + 8U : 0U);
  }
}

}  // namespace writer_test
}  // namespace stormproof::model::fastdds
