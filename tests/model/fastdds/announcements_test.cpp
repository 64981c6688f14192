// Creation of endpoints over time, announcements with their copies, what recognition sets off and
// in which order, and how packets reach participants on the same host.
#include <gtest/gtest.h>

#include "tests/model/fastdds/fastdds_run.hpp"

namespace stormproof::model::fastdds {
namespace announcements_test {

using Kind = PacketKind;
constexpr std::uint64_t all_others = 100'000;

/// "U1 L2 lM2 M": unicast to 1, the same by loopback to 2, a multicast's loopback copy to 2,
/// multicast.
std::string announcements(const std::vector<Emission>& sent) {
  std::string text;
  for (const Emission& packet : sent) {
    const std::string to = std::to_string(packet.destination);
    if (packet.kind == Kind::spdp_unicast) text += (packet.looped ? " L" : " U") + to;
    if (packet.kind == Kind::spdp_multicast) text += packet.looped ? " lM" + to : " M";
  }
  return text;
}

TEST(FastddsCreation, TheKthEndpointIsCreatedAtItsShareOfTheSpan) {
  Scenario scenario = fastdds_by_hand({{.host = 0}, {.host = 1}});
  scenario.deployment.participants[1].start = Nanoseconds{ms};
  scenario.deployment.participants[1].endpoints_done = Nanoseconds{ms + 100};
  const auto timers = run(scenario).timers(EventKind::endpoint_creation, 1);
  ASSERT_EQ(timers.size(), 17U);
  for (std::int64_t k = 0; k < 17; ++k) {
    EXPECT_EQ(timers[static_cast<std::size_t>(k)].second, ms + 100 * (k + 1) / 17) << k;
  }
}

TEST(FastddsCreation, WithDoneAtTheStartEverythingIsPulledInOneMessagePerStream) {
  const FastddsLog log = run(fastdds_by_hand({{.host = 0}, {.host = 1}}));
  // Announcements 1 ms, HEARTBEATs 2 ms, ACKNACKs at 2.01, 3.01 ms, nack response 100 us later.
  EXPECT_EQ(log.result.discovery_time, Nanoseconds{4 * ms + 110 * us});
  EXPECT_EQ(log.times_of(Kind::data, 0, 1), Times{3 * ms + 110 * us});
  EXPECT_EQ(log.times_of(Kind::data, 0, 1, Stream::sub), Times{3 * ms + 110 * us});
  EXPECT_EQ(log.of(Kind::data, 0, 1)[0].bytes, 20 + 16 + 9 * 12 + 3'808);
  EXPECT_EQ(log.of(Kind::data, 0, 1, Stream::sub)[0].bytes, 20 + 16 + 8 * 12 + 3'440);
  EXPECT_EQ(log.result.counts.initial_data, 34U);
  EXPECT_EQ(log.result.counts.repair_data, 0U);
  EXPECT_EQ(log.result.counts.heartbeat, 4U);
  EXPECT_EQ(log.result.counts.acknack, 4U);
  EXPECT_EQ(log.result.counts.spdp_multicast, 2U);
  EXPECT_EQ(log.result.counts.spdp_unicast, 0U);
}

TEST(FastddsSpdp, UnicastCopiesLeaveBeforeTheMulticastAndSameHostCopiesTakeNoNumber) {
  Scenario scenario = fastdds_by_hand({{.host = 0}, {.host = 1}, {.host = 0}, {.host = 1}});
  scenario.time_limit = Nanoseconds{100 * ms};
  scenario.deployment.participants[3].start = Nanoseconds{sec};  // keeps the run going
  const FastddsLog log = run(scenario);
  EXPECT_EQ(announcements(log.at(0, 0)), " lM2 M");
  const std::vector<Emission> second = log.at(100 * ms, 0);
  EXPECT_EQ(announcements(second), " U1 L2 lM2 M");
  ASSERT_EQ(second.size(), 4U);
  EXPECT_NE(second[0].number, no_number);
  EXPECT_EQ(second[3].number, second[0].number + 1);
  EXPECT_EQ(second[0].bytes, 252);
  EXPECT_EQ(second[3].bytes, 252);
}

TEST(FastddsSpdp, SameHostAnnouncementsCountNothingButTheMulticastItself) {
  Scenario scenario = fastdds_by_hand({{.host = 0}, {.host = 0}, {.host = 1, .start_ns = sec}});
  scenario.dds.spdp.resend = SpdpResend::all_known;
  scenario.time_limit = Nanoseconds{50 * ms};
  const FastddsLog log = run(scenario);
  // Both announce, recognise each other 2 ms later and announce again: four multicasts, and
  // unicast copies only by loopback.
  EXPECT_EQ(log.result.counts.spdp_multicast, 4U);
  EXPECT_EQ(log.result.counts.spdp_unicast, 0U);
  EXPECT_EQ(announcements(log.at(2 * ms, 0)), " L1 lM1 M");
}

TEST(FastddsSpdp, EveryReceiverHasAReceptionOfItsOwnInAscendingOrder) {
  Scenario scenario = fastdds_by_hand({{.host = 0}, {.host = 1}, {.host = 0}, {.host = 2}});
  scenario.time_limit = Nanoseconds{3 * ms};
  std::vector<std::pair<std::int64_t, std::uint32_t>> receivers;
  for (const Reception& r : run(scenario).received) {
    if (r.kind == Kind::spdp_multicast && r.number == 0 && r.receiver != 2) {
      receivers.emplace_back(r.time_ns, r.receiver);
    }
  }
  // Packet 0 is the multicast of participant 0 (loopback copies have number 0 too, but go to 2).
  ASSERT_EQ(receivers.size(), 3U);
  EXPECT_EQ(receivers[0], std::pair(ms, 1U));
  EXPECT_EQ(receivers[1], std::pair(ms, 3U));
  EXPECT_EQ(receivers[2], std::pair(2 * ms, 0U));  // the loopback copy of participant 2's
}

TEST(FastddsSpdp, WhatArrivesBeforeTheStartIsIgnored) {
  const FastddsLog log = run(fastdds_by_hand({{.host = 0}, {.host = 1, .start_ns = 50 * ms}}));
  // 1 announces at 50 ms, and 0 recognises it at 51 ms; 0 announces again at 100 ms.
  EXPECT_EQ(log.times_of(Kind::heartbeat, 0, 1).at(0), 51 * ms);
  EXPECT_EQ(log.times_of(Kind::heartbeat, 1, 0).at(0), 101 * ms);
}

TEST(FastddsSpdp, TheResendIsThatOfTheProfile) {
  const std::vector<std::pair<SpdpResend, std::string>> cases{
      {SpdpResend::all_known, " U1 L2 lM2 M"},
      {SpdpResend::new_and_multicast, " L2 lM2 M"},
      {SpdpResend::new_only, " L2"},
      {SpdpResend::none, ""}};
  for (const auto& [resend, expected] : cases) {
    Scenario scenario = fastdds_by_hand(
        {{.host = 0}, {.host = 1, .start_ns = 20 * ms}, {.host = 0, .start_ns = 40 * ms}});
    scenario.dds.spdp.resend = resend;
    scenario.time_limit = Nanoseconds{42 * ms};
    const FastddsLog log = run(scenario);
    // 0 knows 1 since 21 ms; 2's multicast reaches 0 by loopback.
    EXPECT_EQ(announcements(log.at(42 * ms, 0)), expected);
  }
}

TEST(FastddsSpdp, ANewParticipantIsAnsweredBeforeItsReadersAreMatched) {
  Scenario scenario = fastdds_by_hand({{.host = 0}, {.host = 1}, {.host = 0}});
  scenario.dds.spdp.resend = SpdpResend::new_only;
  scenario.time_limit = Nanoseconds{2 * ms};
  const FastddsLog log = run(scenario);
  const auto kinds = [](const std::vector<Emission>& sent, std::uint32_t destination) {
    std::vector<std::pair<Kind, Stream>> list;
    for (const Emission& packet : sent) {
      if (packet.destination == destination) list.emplace_back(packet.kind, packet.stream);
    }
    return list;
  };
  const std::pair spdp{Kind::spdp_unicast, Stream::pub};
  const std::pair pub{Kind::heartbeat, Stream::pub};
  const std::pair sub{Kind::heartbeat, Stream::sub};
  const std::pair liveliness{Kind::user_heartbeat, Stream::pub};
  EXPECT_EQ(kinds(log.at(ms, 0), 1), (std::vector{spdp, pub, sub, liveliness}));
  const auto same_host = kinds(log.at(2 * ms, 0), 2);
  ASSERT_GE(same_host.size(), 3U);  // no liveliness relation within a host
  EXPECT_EQ((std::vector{same_host[0], same_host[1], same_host[2]}), (std::vector{spdp, pub, sub}));
  for (const auto& [kind, stream] : same_host) EXPECT_NE(kind, Kind::user_heartbeat);
}

TEST(FastddsLoopback, SameHostPacketsTakeTheLoopbackDelayAndNoChannel) {
  Scenario scenario = fastdds_by_hand({{.host = 0}, {.host = 0}, {.host = 1, .start_ns = sec}});
  scenario.deployment.loopback_delay = Nanoseconds{300 * us};
  scenario.time_limit = Nanoseconds{50 * ms};
  const FastddsLog log = run(scenario);
  const std::vector<Emission> data = log.of(Kind::data, 0, 1);
  ASSERT_EQ(data.size(), 1U);
  EXPECT_TRUE(data[0].looped);
  // Announcement, HEARTBEAT and ACKNACK take 300 us each; then 10 us and 100 us of delays.
  EXPECT_EQ(data[0].time_ns, 900 * us + 110 * us);
  EXPECT_EQ(data[0].descriptors.size(), 9U);
}

TEST(FastddsLoopback, CompletionAndCountsLookAtCrossHostPairsOnly) {
  Scenario scenario = fastdds_by_hand({{.host = 0}, {.host = 0}, {.host = 1, .start_ns = sec}});
  scenario.time_limit = Nanoseconds{50 * ms};
  const FastddsLog log = run(scenario);
  EXPECT_EQ(log.of(Kind::data, 0, 1).size(), 1U);  // they have discovered each other
  EXPECT_EQ(log.result.counts.initial_data, 0U);
  EXPECT_EQ(log.result.counts.heartbeat, 0U);
  EXPECT_EQ(log.result.counts.acknack, 0U);
  EXPECT_EQ(log.result.useful_deliveries, 0U);
  EXPECT_EQ(log.result.missing_count, 4U * 17U);  // between either of them and 2
  EXPECT_EQ(log.result.end, RunEnd::time_limit);
}

TEST(FastddsLoss, ALostAnnouncementIsMadeGoodByTheNextOne) {
  Scenario scenario = fastdds_by_hand({{.host = 0}, {.host = 1}});
  lose(scenario, 0, 1);  // 0's first announcement
  const FastddsLog log = run(scenario);
  EXPECT_EQ(log.times_of(Kind::heartbeat, 0, 1).at(0), ms);
  EXPECT_EQ(log.times_of(Kind::heartbeat, 1, 0).at(0), 101 * ms);
  EXPECT_TRUE(log.result.completed());
}

TEST(FastddsLoss, NothingArrivesWhenEverythingIsLost) {
  Scenario scenario = fastdds_by_hand({{.host = 0}, {.host = 1}});
  scenario.time_limit = Nanoseconds{sec};
  lose(scenario, 0, all_others);
  const FastddsLog log = run(scenario);
  EXPECT_TRUE(log.received.empty());
  EXPECT_EQ(log.result.counts.spdp_multicast, 12U);  // 0, 100, …, 500 ms, twice
  EXPECT_EQ(log.result.counts.heartbeat, 0U);
}

}  // namespace announcements_test
}  // namespace stormproof::model::fastdds
