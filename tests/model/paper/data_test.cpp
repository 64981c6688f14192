// DATA packets: sizes, grouping, and the piggyback HEARTBEAT under its three readings.
#include <gtest/gtest.h>

#include "tests/model/run_log.hpp"

namespace stormproof::model {
namespace data_test {

std::vector<std::int64_t> payloads(const Scenario& scenario, Stream s = Stream::pub) {
  std::vector<std::int64_t> list;
  for (const Sent& data : run_and_log(scenario).of(PacketKind::data, 0, 1, s)) {
    list.push_back(data.payload_bytes);
  }
  return list;
}

using Payloads = std::vector<std::int64_t>;

TEST(Data, DescriptorsOfOnePacketShareItsHeader) {
  EXPECT_EQ(payloads(by_hand({{0, 4}, {1, 0}})), Payloads{460 + 3 * 424});
}

TEST(Data, DefaultDescriptorsGrowLinearlyAndComeFirst) {
  Scenario scenario = by_hand({{0, 1, 0, 1}, {1, 0}});
  scenario.dds.descriptors = DescriptorProfile{};
  // 452, 462, …, 532, then 460.
  EXPECT_EQ(payloads(scenario), Payloads{452 + (8 * 416 + 360) + 424});
  // 452 + 80k/7 rounded down: 452, 463, 474, 486, 497, 509, 520, 532, then 460.
  EXPECT_EQ(payloads(scenario, Stream::sub), Payloads{452 + (7 * 416 + 317) + 424});
}

TEST(Data, ASingleDefaultDescriptorHasTheFirstSize) {
  Scenario scenario = by_hand({{0, 0}, {1, 0}});
  scenario.dds.descriptors.default_publications = 1;
  EXPECT_EQ(payloads(scenario), Payloads{452});
}

TEST(Data, GroupingLimitsThePayload) {
  Scenario scenario = by_hand({{0, 7}, {1, 0}});
  scenario.dds.sedp.grouping = Grouping::mtu;  // 1,472 B: three of these descriptors
  EXPECT_EQ(payloads(scenario), (Payloads{1'308, 1'308, 460}));
  scenario.dds.sedp.grouping = Grouping::single;
  EXPECT_EQ(payloads(scenario), Payloads(7, 460));
}

TEST(Data, APacketMayReachTheLimitExactly) {
  Scenario scenario = by_hand({{0, 3}, {1, 0}});
  scenario.dds.sedp.grouping_limit_bytes = Bytes{884};
  EXPECT_EQ(payloads(scenario), (Payloads{884, 460}));
  scenario.dds.sedp.grouping_limit_bytes = Bytes{883};
  EXPECT_EQ(payloads(scenario), (Payloads{460, 460, 460}));
  scenario.dds.sedp.grouping_limit_bytes = Bytes{1};  // a descriptor alone always goes
  EXPECT_EQ(payloads(scenario), (Payloads{460, 460, 460}));
}

Scenario with_piggyback(Piggyback kind, std::int64_t threshold) {
  Scenario scenario = by_hand({{0, 3, 0, 1}, {1, 0}});
  scenario.dds.sedp.piggyback = kind;
  scenario.dds.sedp.piggyback_threshold_bytes = Bytes{threshold};
  return scenario;
}

TEST(Piggyback, LinearChargesWhatIsAdded) {
  // 1000 − 460 − 424 − 424 < 0 with the third descriptor.
  EXPECT_EQ(payloads(with_piggyback(Piggyback::linear, 1'000)), Payloads{1'308 + 32});
  // The budget of the other stream is its own.
  EXPECT_EQ(payloads(with_piggyback(Piggyback::linear, 1'000), Stream::sub), Payloads{460});
}

TEST(Piggyback, CumulativeChargesAllThatTheParticipantHasEverSent) {
  // Sent 460: 540 left. Sent 884: negative, HEARTBEAT, sent 916. Sent 1340: negative again.
  EXPECT_EQ(payloads(with_piggyback(Piggyback::cumulative, 1'000)), Payloads{1'308 + 2 * 32});
  // The count is the participant's: the first descriptor of the other stream is charged with it.
  EXPECT_EQ(payloads(with_piggyback(Piggyback::cumulative, 1'000), Stream::sub),
            Payloads{460 + 32});
}

TEST(Piggyback, ABudgetOfExactlyZeroIsNotUsedUp) {
  EXPECT_EQ(payloads(with_piggyback(Piggyback::linear, 1'308)), Payloads{1'308});
  EXPECT_EQ(payloads(with_piggyback(Piggyback::linear, 1'307)), Payloads{1'308 + 32});
}

TEST(Piggyback, OffAddsNothing) {
  EXPECT_EQ(payloads(with_piggyback(Piggyback::off, 1)), Payloads{1'308});
}

TEST(Piggyback, WithOneOpenRelationTheHeartbeatRides) {
  const RunLog log = run_and_log(with_piggyback(Piggyback::linear, 1));
  ASSERT_EQ(log.of(PacketKind::data, 0, 1).size(), 1U);
  EXPECT_TRUE(log.of(PacketKind::data, 0, 1)[0].carries_heartbeat);
  EXPECT_EQ(log.of(PacketKind::heartbeat, 0, 1).size(), 1U);  // of the opening
  // 3 + 1 that ride, 2 of the openings towards 1, 2 towards 0.
  EXPECT_EQ(log.result.counts.heartbeat, 8U);
}

TEST(Piggyback, WithSeveralOpenRelationsItGoesToAllOfThem) {
  Scenario scenario = by_hand({{0, 2}, {1, 0}, {1, 0}});
  scenario.dds.sedp.piggyback = Piggyback::linear;
  scenario.dds.sedp.piggyback_threshold_bytes = Bytes{1};
  scenario.dds.spdp.resend = SpdpResend::none;
  std::vector<std::string> list;
  const RunLog log = run_and_log(scenario);
  for (const Sent& packet : log.sent) {
    if (packet.source != 0 || packet.stream != Stream::pub || packet.time_ns != ms) continue;
    if (packet.kind == PacketKind::data) {
      list.push_back("data>" + std::to_string(packet.destination) + " of " +
                     std::to_string(packet.descriptors.size()));
    }
    if (packet.kind == PacketKind::heartbeat)
      list.push_back("hb>" + std::to_string(packet.destination));
  }
  EXPECT_EQ(list, (std::vector<std::string>{"data>1 of 2", "hb>1",          // first opening
                                            "data>2 of 1", "hb>1", "hb>2",  // second one
                                            "data>2 of 1", "hb>1", "hb>2", "hb>2"}));
}

TEST(Piggyback, TheHeartbeatToAllIsChargedOnce) {
  // Three descriptors of 460 B, a packet each, to two readers. The first relation brings the bytes
  // sent to 1380, the second one to 1840 and 2300; there the budget is used up, and 68 B are
  // charged, not 68 for each reader. So the last descriptor is charged with 2300 + 68 + 460 = 2828
  // B.
  Scenario scenario = by_hand({{0, 3}, {1, 0}, {1, 0}});
  scenario.dds.sedp.piggyback = Piggyback::cumulative;
  scenario.dds.sedp.grouping = Grouping::single;
  scenario.dds.spdp.resend = SpdpResend::none;
  const auto heartbeats_to_1 = [&](std::int64_t threshold) {
    scenario.dds.sedp.piggyback_threshold_bytes = Bytes{threshold};
    return run_and_log(scenario).of(PacketKind::heartbeat, 0, 1).size();
  };
  EXPECT_EQ(heartbeats_to_1(2'828), 2U);  // of the opening, and one to all
  EXPECT_EQ(heartbeats_to_1(2'827), 3U);  // and one more to all with the last descriptor
}

}  // namespace data_test
}  // namespace stormproof::model
