// How descriptors become messages, and what each of them is charged against the piggyback budget:
// thresholds are chosen so that one byte more or less makes the difference.
#include <gtest/gtest.h>

#include "model/fastdds/endpoints.hpp"
#include "tests/model/fastdds/fastdds_run.hpp"

namespace stormproof::model::fastdds {
namespace sender_test {

using Kind = PacketKind;
constexpr std::int64_t pulled_ns = 3'110 * us;  // when what existed at the match is sent
constexpr std::int64_t pub_bytes = 9 * 12 + 3'808;
constexpr std::int64_t sub_bytes = 8 * 12 + 3'440;

Scenario charged(Scenario scenario, Piggyback piggyback, std::int64_t threshold) {
  scenario.dds.sedp.piggyback = piggyback;
  scenario.dds.sedp.piggyback_threshold_bytes = Bytes{threshold};
  scenario.time_limit = Nanoseconds{4 * ms};
  return scenario;
}

/// HEARTBEATs that ride in the first DATA packet of this stream from 0 to 1.
std::uint32_t riding(const Scenario& scenario, Stream s = Stream::pub) {
  return run(scenario).of(Kind::data, 0, 1, s).at(0).heartbeats;
}

/// 1 and 2 want the descriptors of 0, but 2's first ACKNACK about the publications is lost.
Scenario only_one_asks() {
  Scenario scenario = charged(one_writer(0, 2), Piggyback::linear, 1);
  const std::uint64_t lost = run(scenario).of(Kind::acknack, 2, 0).at(0).number;
  lose(scenario, lost, lost + 1);
  return scenario;
}

TEST(FastddsSender, APushIsAMessageOfItsOwn) {
  const FastddsLog log = run(charged(one_writer(400 * us), Piggyback::off, 1));
  EXPECT_EQ(log.of(Kind::data, 0, 1).at(0).bytes, 20 + 16 + 12 + 384);
  EXPECT_EQ(log.of(Kind::data, 0, 1).at(1).bytes, 20 + 16 + 12 + 428);
}

TEST(FastddsSender, SeveralDestinationsGetAPacketEachAndAreNotNamedInIt) {
  const FastddsLog log = run(charged(one_writer(0, 2), Piggyback::off, 1));
  const std::vector<Emission> to_1 = log.of(Kind::data, 0, 1);
  const std::vector<Emission> to_2 = log.of(Kind::data, 0, 2);
  ASSERT_EQ(to_1.size(), 1U);
  ASSERT_EQ(to_2.size(), 1U);
  EXPECT_EQ(to_1[0].bytes, 20 + pub_bytes);
  EXPECT_EQ(to_2[0].bytes, 20 + pub_bytes);
  EXPECT_EQ(to_2[0].number, to_1[0].number + 1);
  EXPECT_EQ(log.result.counts.initial_data, 2U * 17U);
}

TEST(FastddsSender, OneAsynchronousRunServesBothStreamsInMessagesOfTheirOwn) {
  const FastddsLog log = run(charged(one_writer(0), Piggyback::off, 1));
  EXPECT_EQ(log.timers(EventKind::async_run, 0), (std::vector{std::pair(pulled_ns, pulled_ns)}));
  std::vector<Emission> data;
  for (const Emission& packet : log.at(pulled_ns, 0)) {
    if (packet.kind == Kind::data) data.push_back(packet);
  }
  ASSERT_EQ(data.size(), 2U);
  EXPECT_EQ(data[0].stream, Stream::pub);
  EXPECT_EQ(data[0].bytes, 36 + pub_bytes);
  EXPECT_EQ(data[1].stream, Stream::sub);
  EXPECT_EQ(data[1].bytes, 36 + sub_bytes);
}

TEST(FastddsSender, AMessageIsFullAt65500BytesButAHeartbeatStillFits) {
  Scenario scenario = charged(one_writer(0), Piggyback::off, 1);
  scenario.deployment.participants[0].publications = 170;
  const std::vector<Emission> plain = run(scenario).of(Kind::data, 0, 1);
  ASSERT_EQ(plain.size(), 2U);
  EXPECT_EQ(plain[0].descriptors.size(), 161U);
  EXPECT_EQ(plain[0].bytes, 36 + pub_bytes + 152 * 404);
  EXPECT_EQ(plain[1].bytes, 36 + 18 * 404);
  const std::vector<Emission> full =
      run(charged(scenario, Piggyback::linear, 424)).of(Kind::data, 0, 1);
  ASSERT_EQ(full.size(), 2U);
  EXPECT_EQ(full[0].descriptors.size(), 155U);
  EXPECT_EQ(full[0].heartbeats, 81U);
  EXPECT_EQ(full[0].bytes, 36 + pub_bytes + 146 * 404 + 81 * 32);
  EXPECT_GT(full[0].bytes, 65'500);
}

TEST(FastddsSender, TheProfileLimitsTheMessageButNeverBelowOneDescriptor) {
  Scenario scenario = charged(one_writer(0), Piggyback::off, 1);
  const auto packets_with_limit = [&](std::int64_t bytes) {
    scenario.dds.sedp.grouping_limit_bytes = Bytes{bytes};
    return run(scenario).of(Kind::data, 0, 1);
  };
  const std::vector<Emission> fitting = packets_with_limit(1'472);
  for (const Emission& packet : fitting) EXPECT_LE(packet.bytes, 1'472);
  EXPECT_GT(fitting.front().descriptors.size(), 1U);
  const std::vector<Emission> alone = packets_with_limit(1);
  for (const Emission& packet : alone) EXPECT_EQ(packet.descriptors.size(), 1U);
  EXPECT_EQ(alone.size(), 9U);  // of the publications
}

TEST(FastddsSender, AHeartbeatRidesInAMessageToAllReadersAndCountsOnceForEach) {
  const FastddsLog log = run(charged(one_writer(0, 2), Piggyback::linear, 1));
  for (const std::uint32_t j : {1U, 2U}) {
    const std::vector<Emission> data = log.of(Kind::data, 0, j);
    ASSERT_EQ(data.size(), 1U);  // DATA joins a message that carries a HEARTBEAT
    EXPECT_EQ(data[0].heartbeats, 9U);
    EXPECT_EQ(data[0].detail, 9U);
    EXPECT_EQ(data[0].bytes, 20 + pub_bytes + 9 * 32);
  }
  // Riding: 17 to each of two readers. Of openings: 4 by 0, 2 by each reader.
  EXPECT_EQ(log.result.counts.heartbeat, 17U * 2U + 4U + 2U * 2U);
}

TEST(FastddsSender, ASameHostReaderGetsTheHeartbeatButIsNotCounted) {
  Scenario scenario = charged(one_writer(0, 2), Piggyback::linear, 1);
  scenario.deployment.participants[2].host = HostId{0};
  scenario.deployment.loopback_delay = Nanoseconds{ms};
  const FastddsLog log = run(scenario);
  ASSERT_EQ(log.of(Kind::data, 0, 2).size(), 1U);
  EXPECT_EQ(log.of(Kind::data, 0, 2)[0].heartbeats, 9U);
  EXPECT_EQ(log.of(Kind::data, 0, 2)[0].bytes, 20 + pub_bytes + 9 * 32);
  EXPECT_TRUE(log.of(Kind::data, 0, 2)[0].looped);
  // Riding: 17 to the cross-host reader. Openings: 0 and 1, 1 and 2, each two streams.
  EXPECT_EQ(log.result.counts.heartbeat, 17U + 8U);
  // 0 to 1; 2 exists for 1 as well, but creates nothing in this time.
  EXPECT_EQ(log.result.counts.initial_data, 17U);
}

TEST(FastddsSender, AMessageToSomeReadersIsFlushedAndTheHeartbeatGoesToAll) {
  const FastddsLog log = run(only_one_asks());
  std::vector<Emission> sent;
  for (const Emission& packet : log.at(pulled_ns, 0)) {
    if (packet.stream == Stream::pub) sent.push_back(packet);
  }
  ASSERT_EQ(sent.size(), 27U);
  for (std::uint32_t d = 0; d < 9; ++d) {
    const Emission& data = sent[3 * d];
    EXPECT_EQ(data.kind, Kind::data);
    EXPECT_EQ(data.destination, 1U);
    EXPECT_EQ(data.descriptors, Numbers{d});
    EXPECT_EQ(data.heartbeats, 0U);
    for (std::uint32_t j = 1; j <= 2; ++j) {
      const Emission& heartbeat = sent[3 * d + j];
      EXPECT_EQ(heartbeat.kind, Kind::heartbeat);
      EXPECT_EQ(heartbeat.destination, j);
      EXPECT_EQ(heartbeat.bytes, 20 + 32);
      EXPECT_EQ(heartbeat.detail, 9U);
    }
  }
}

TEST(FastddsSender, APushIsChargedWithoutTheDestination) {
  Scenario scenario = one_writer(2 * ms);
  for (const Piggyback piggyback : {Piggyback::cumulative, Piggyback::linear}) {
    // pub0 is pushed at 2 ms: a packet of 460 bytes, of which 16 name its destination.
    EXPECT_EQ(riding(charged(scenario, piggyback, 444)), 0U);
    EXPECT_EQ(riding(charged(scenario, piggyback, 443)), 1U);
  }
  EXPECT_EQ(run(charged(scenario, Piggyback::linear, 443)).of(Kind::data, 0, 1).at(0).bytes, 492);
  EXPECT_EQ(riding(charged(scenario, Piggyback::off, 0)), 0U);
}

TEST(FastddsSender, LinearChargesEachDescriptorAloneInTheAsynchronousPathToo) {
  const std::int64_t sum = 9 * 32 + 3'808;
  EXPECT_EQ(riding(charged(one_writer(0), Piggyback::linear, sum)), 0U);
  EXPECT_EQ(riding(charged(one_writer(0), Piggyback::linear, sum - 1)), 1U);
}

/// What the pulled descriptors of a stream are charged: for each of them all bytes sent before, and
/// the message so far.
std::int64_t cumulative_charge(Stream s, std::uint32_t count, std::int64_t sent,
                               std::int64_t header) {
  std::int64_t charge = 0;
  std::int64_t message = header;
  for (std::uint32_t d = 0; d < count; ++d) {
    message += 12 + submessage_bytes(s, d);
    charge += sent + message;
  }
  return charge;
}

TEST(FastddsSender, TheCumulativeChargeOfADescriptorIsAllThatTheQueueHasEverSent) {
  const std::int64_t pub = cumulative_charge(Stream::pub, 9, 0, 36);
  EXPECT_EQ(pub, 19'772);
  EXPECT_EQ(riding(charged(one_writer(0), Piggyback::cumulative, pub)), 0U);
  EXPECT_EQ(riding(charged(one_writer(0), Piggyback::cumulative, pub - 1)), 1U);
  // The other stream has a budget of its own, but the bytes sent are the participant's.
  const std::int64_t sub = cumulative_charge(Stream::sub, 8, 36 + pub_bytes, 36);
  EXPECT_EQ(riding(charged(one_writer(0), Piggyback::cumulative, sub), Stream::sub), 0U);
  EXPECT_EQ(riding(charged(one_writer(0), Piggyback::cumulative, sub - 1), Stream::sub), 1U);
}

TEST(FastddsSender, AMessageToSeveralIsChargedOnce) {
  const std::int64_t sub = cumulative_charge(Stream::sub, 8, 20 + pub_bytes, 20);
  EXPECT_EQ(riding(charged(one_writer(0, 2), Piggyback::cumulative, sub), Stream::sub), 0U);
  EXPECT_EQ(riding(charged(one_writer(0, 2), Piggyback::cumulative, sub - 1), Stream::sub), 1U);
}

TEST(FastddsSender, WhatWasPushedIsNotInTheCumulativeCharge) {
  for (const auto& [threshold, heartbeats] : {std::pair{460, 0U}, std::pair{459, 1U}}) {
    Scenario scenario = charged(one_writer(10 * ms), Piggyback::cumulative, threshold);
    scenario.time_limit = Nanoseconds{45 * ms};
    const std::uint64_t lost = run(scenario).number_of_data(0, 1, 0);
    lose(scenario, lost, lost + 1);
    const FastddsLog log = run(scenario);
    // A HEARTBEAT rides with pub1 at 30 ms and brings a request for pub0: the first message of the
    // asynchronous path, 460 bytes, after 876 pushed ones.
    const std::vector<Emission> data = log.of(Kind::data, 0, 1);
    ASSERT_EQ(data.size(), 3U);
    EXPECT_EQ(data[1].heartbeats, 1U);
    EXPECT_EQ(data[2].descriptors, Numbers{0});
    EXPECT_EQ(data[2].time_ns, 32 * ms + 110 * us);
    EXPECT_EQ(data[2].heartbeats, heartbeats);
    EXPECT_EQ(log.result.counts.repair_data, 1U);
  }
}

TEST(FastddsSender, SameHostReadersFeedTheCumulativeCharge) {
  const auto first_message = [](std::uint32_t neighbour_host) {
    Scenario scenario = charged(one_writer(0, 2), Piggyback::cumulative, 19'772);
    scenario.dds.spdp.resend = SpdpResend::new_only;
    scenario.deployment.participants[1].start = Nanoseconds{50 * ms};
    scenario.deployment.participants[2].host = HostId{neighbour_host};
    if (neighbour_host != 0) scenario.deployment.participants[2].start = Nanoseconds{sec};
    scenario.time_limit = Nanoseconds{55 * ms};
    return run(scenario).of(Kind::data, 0, 1).at(0);
  };
  // Alone, 1 gets all of them in one message. After the 7,588 bytes that went to the neighbour
  // the third descriptor already exhausts the budget, and the message ends there.
  EXPECT_EQ(first_message(1).descriptors.size(), 9U);
  EXPECT_EQ(first_message(1).heartbeats, 0U);
  EXPECT_EQ(first_message(0).descriptors, (Numbers{0, 1, 2}));
}

}  // namespace sender_test
}  // namespace stormproof::model::fastdds
