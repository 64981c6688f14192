// Announcements and the opening of relations, in scenarios small enough to be worked out by hand: a
// constant delay of one millisecond, and only the packets under test are received.
#include <gtest/gtest.h>

#include "tests/model/run_log.hpp"

namespace stormproof::model {
namespace announcements_test {

constexpr std::uint64_t all_others = 100'000;

/// The times at which `source` sends its multicast announcement.
std::vector<std::int64_t> announcements(const RunLog& log, std::uint32_t source) {
  return log.times_of(PacketKind::spdp_multicast, source, Sent::everybody);
}

/// "kind source>destination" of each packet sent at `time_ns`.
std::vector<std::string> sent_at(const RunLog& log, std::int64_t time_ns) {
  std::vector<std::string> list;
  for (const Sent& packet : log.sent) {
    if (packet.time_ns != time_ns) continue;
    std::string text = std::string{name_of(packet.kind)} + " " + std::to_string(packet.source);
    if (packet.destination != Sent::everybody) text += ">" + std::to_string(packet.destination);
    if (packet.kind == PacketKind::data || packet.kind == PacketKind::heartbeat) {
      text += std::string{" "} + name_of(packet.stream);
    }
    list.push_back(text);
  }
  return list;
}

TEST(Announcements, FollowTheStartupScheduleAndThenThePeriod) {
  Scenario scenario = by_hand({{0, 1}, {1, 1, 40 * ms}});
  scenario.time_limit = Nanoseconds{7 * sec};
  lose(scenario, 0, all_others);
  const RunLog log = run_and_log(scenario);
  EXPECT_EQ(announcements(log, 0),
            (std::vector<std::int64_t>{0, 100 * ms, 200 * ms, 300 * ms, 400 * ms, 500 * ms,
                                       3'500 * ms, 6'500 * ms}));
  EXPECT_EQ(announcements(log, 1).at(6), 3'540 * ms);
  EXPECT_EQ(log.result.counts.spdp_unicast, 0U);
}

TEST(Announcements, AParticipantAcceptsWhatReachesItExactlyAtItsStart) {
  Scenario scenario = by_hand({{0, 1}, {1, 0, ms}});
  scenario.dds.spdp.resend = SpdpResend::none;
  EXPECT_EQ(run_and_log(scenario).times_of(PacketKind::data, 0, 1), std::vector<std::int64_t>{ms});
}

TEST(Announcements, AParticipantIgnoresWhatReachesItBeforeItsStart) {
  Scenario scenario = by_hand({{0, 1}, {1, 0, ms + 1}});
  scenario.dds.spdp.resend = SpdpResend::none;
  EXPECT_EQ(run_and_log(scenario).times_of(PacketKind::data, 0, 1),
            std::vector<std::int64_t>{101 * ms});
}

TEST(Announcements, RecognitionResendsThenOpensStreamByStream) {
  Scenario scenario = by_hand({{0, 2, 0, 1}, {1, 0}});
  scenario.time_limit = Nanoseconds{50 * ms};
  lose(scenario, 1, all_others);
  EXPECT_EQ(sent_at(run_and_log(scenario), ms),
            (std::vector<std::string>{"spdp_multicast 1", "spdp_unicast 1>0", "data 0>1 pub",
                                      "heartbeat 0>1 pub", "data 0>1 sub", "heartbeat 0>1 sub"}));
}

TEST(Announcements, WithPullNothingIsSentAtTheOpeningButAHeartbeat) {
  Scenario scenario = by_hand({{0, 2, 0, 1}, {1, 0}});
  scenario.dds.sedp.initial_data = InitialData::pull;
  scenario.dds.spdp.resend = SpdpResend::none;
  scenario.time_limit = Nanoseconds{50 * ms};
  lose(scenario, 1, all_others);
  EXPECT_EQ(sent_at(run_and_log(scenario), ms),
            (std::vector<std::string>{"heartbeat 0>1 pub", "heartbeat 0>1 sub"}));
}

TEST(Announcements, EachSideOpensItsOwnWriter) {
  Scenario scenario = by_hand({{0, 1}, {1, 1}});
  scenario.dds.sedp.relation_opening = RelationOpening::each_side;
  scenario.time_limit = Nanoseconds{50 * ms};
  lose(scenario, 1, all_others);  // 1 recognises 0, and 0 does not recognise 1
  const RunLog log = run_and_log(scenario);
  EXPECT_EQ(log.times_of(PacketKind::heartbeat, 1, 0), std::vector<std::int64_t>{ms});
  EXPECT_EQ(log.times_of(PacketKind::data, 1, 0), std::vector<std::int64_t>{ms});
  EXPECT_TRUE(log.of(PacketKind::heartbeat, 0, 1).empty());
  EXPECT_TRUE(log.of(PacketKind::data, 0, 1).empty());
}

TEST(Announcements, ARecognisedParticipantIsNotRecognisedAgain) {
  Scenario scenario = by_hand({{0, 1}, {1, 0}, {1, 0, 400 * ms}});
  scenario.time_limit = Nanoseconds{350 * ms};
  const RunLog log = run_and_log(scenario);
  EXPECT_EQ(log.of(PacketKind::data, 0, 1).size(), 1U);
  // 0 to 1: the copy at recognition, and one with each of the announcements 1, 2 and 3.
  EXPECT_EQ(log.times_of(PacketKind::spdp_unicast, 0, 1),
            (std::vector<std::int64_t>{ms, 100 * ms, 200 * ms, 300 * ms}));
}

struct ResendCase {
  SpdpResend resend;
  std::uint64_t multicast;
  std::uint64_t unicast;
};

TEST(Announcements, WhatRecognitionSendsDependsOnTheProfile) {
  // Three participants at t = 0. Then 1 and 2 recognise 0, and 0 recognises 1 and after it 2.
  for (const ResendCase& c :
       {ResendCase{SpdpResend::all_known, 7, 5},  // 0 sends to 1, then to 1 and 2
        ResendCase{SpdpResend::new_and_multicast, 7, 4}, ResendCase{SpdpResend::new_only, 3, 4},
        ResendCase{SpdpResend::none, 3, 0}}) {
    Scenario scenario = by_hand({{0, 1}, {1, 1}, {1, 1}});
    scenario.dds.spdp.resend = c.resend;
    const RunResult result = run_and_log(scenario).result;
    EXPECT_EQ(result.discovery_time, Nanoseconds{2 * ms});
    EXPECT_EQ(result.counts.spdp_multicast, c.multicast);
    EXPECT_EQ(result.counts.spdp_unicast, c.unicast);
  }
}

TEST(Announcements, ALostMulticastIsReceivedByNobody) {
  Scenario scenario = by_hand({{0, 1}, {1, 0}, {2, 0}});
  scenario.dds.spdp.resend = SpdpResend::none;
  scenario.time_limit = Nanoseconds{150 * ms};
  lose(scenario, 0, 1);
  const RunLog log = run_and_log(scenario);
  EXPECT_EQ(log.times_of(PacketKind::data, 0, 1), std::vector<std::int64_t>{101 * ms});
  EXPECT_EQ(log.times_of(PacketKind::data, 0, 2), std::vector<std::int64_t>{101 * ms});
}

}  // namespace announcements_test
}  // namespace stormproof::model
