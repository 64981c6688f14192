// What goes into a unit at the edges of its limits, which flow is next, and in which order the ends
// of a unit's frames have their effects.
#include "model/engine/unit_channel.hpp"

#include <gtest/gtest.h>

#include "tests/model/packet_feed.hpp"

namespace stormproof::model {
namespace unit_channel_test {

using vectors::units_of_80211n;
constexpr std::int64_t one_access = 201'924;  // 134 bytes alone
constexpr std::int64_t two_frames = 214'012;  // 134 bytes twice

std::size_t frames_of_134_bytes_in_a_unit(const WirelessProfile& wireless) {
  UnitChannel channel{wireless, 2};
  for (std::uint32_t k = 0; k < 3; ++k) channel.request_uplink(0, {k, k, 0, 134}, {});
  return channel.take().frames.size();
}

TEST(UnitChannel, AUnitMayHaveExactlyTheMostBytes) {
  WirelessProfile wireless = units_of_80211n();
  wireless.aggregation.max_bytes = Bytes{280};
  EXPECT_EQ(frames_of_134_bytes_in_a_unit(wireless), 2U);
  wireless.aggregation.max_bytes = Bytes{279};
  EXPECT_EQ(frames_of_134_bytes_in_a_unit(wireless), 1U);
}

TEST(UnitChannel, AUnitMayTakeExactlyTheLongestAirtime) {
  WirelessProfile wireless = units_of_80211n();
  const std::int64_t airtime = UnitChannel::airtime_ns(280, {0, 144'400'000});
  EXPECT_EQ(airtime, two_frames - wireless.aggregation.overhead.count());
  wireless.aggregation.max_airtime = Nanoseconds{airtime};
  EXPECT_EQ(frames_of_134_bytes_in_a_unit(wireless), 2U);
  wireless.aggregation.max_airtime = Nanoseconds{airtime - 1};
  EXPECT_EQ(frames_of_134_bytes_in_a_unit(wireless), 1U);
}

TEST(UnitChannel, TheFirstFrameAlwaysFits) {
  WirelessProfile wireless = units_of_80211n();
  wireless.aggregation.max_bytes = Bytes{1};
  wireless.aggregation.max_airtime = Nanoseconds{0};
  EXPECT_EQ(frames_of_134_bytes_in_a_unit(wireless), 1U);
}

TEST(UnitChannel, WhatWasPutBackIsNextWhateverItsFlowHasLeft) {
  WirelessProfile wireless = units_of_80211n();
  wireless.queueing = Queueing::flows;
  wireless.aggregation.max_bytes = Bytes{280};
  UnitChannel channel{wireless, 1};
  const Flow first{false, 0, 1, 0};
  const Flow second{false, 0, 1, 1};
  channel.request_uplink(0, {0, 0, 0, 134}, first);
  channel.request_uplink(0, {1, 1, 0, 400}, first);
  channel.request_uplink(0, {2, 2, 0, 134}, second);
  EXPECT_EQ(channel.take().frames.size(), 1U);  // the second frame does not fit
  EXPECT_EQ(channel.size(), 2U);
  const Unit put_back = channel.take();
  ASSERT_EQ(put_back.frames.size(), 1U);
  EXPECT_EQ(put_back.frames[0].slot, 1U);
  EXPECT_EQ(channel.take().frames[0].slot, 2U);
  EXPECT_TRUE(channel.empty());
}

TEST(UnitChannel, AFlowBeginsAnewWhenItHasLeftTheLists) {
  WirelessProfile wireless = units_of_80211n();
  wireless.queueing = Queueing::flows;
  wireless.aggregation.max_frames = 1;
  UnitChannel channel{wireless, 1};
  const Flow busy{false, 0, 1, 0};
  const Flow sparse{false, 0, 1, 1};
  for (std::uint32_t k = 0; k < 4; ++k) channel.request_uplink(0, {k, k, 0, 200}, busy);
  EXPECT_EQ(channel.take().frames[0].slot, 0U);
  EXPECT_EQ(channel.take().frames[0].slot, 1U);  // 100 bytes of the quantum were left
  channel.request_uplink(0, {4, 4, 0, 50}, sparse);
  EXPECT_EQ(channel.take().frames[0].slot, 4U);  // a new flow goes before the old ones
  EXPECT_EQ(channel.take().frames[0].slot, 2U);
}

TEST(UnitChannel, APacketIsAdmittedBetweenTheFramesOfAUnit) {
  WirelessProfile wireless = units_of_80211n();
  wireless.arbitration = Arbitration::oldest;
  wireless.source_queue_bytes = Bytes{268};  // two packets
  // The third packet's request comes after the first packet's way down and before the second's.
  EXPECT_EQ(arrivals(wireless, 3, {{0, 0, 1, 68}, {0, 0, 2, 68}, {0, 0, 1, 68}}),
            (std::vector{two_frames + one_access, two_frames + 3 * one_access,
                         two_frames + 4 * one_access}));
}

TEST(UnitChannel, APacketLargerThanTheQueueIsAdmittedAlone) {
  WirelessProfile wireless = units_of_80211n();
  wireless.source_queue_bytes = Bytes{100};
  EXPECT_EQ(arrivals(wireless, 2, {{0, 0, 1, 68}, {0, 0, 1, 68}}),
            (std::vector{2 * one_access, 4 * one_access}));
}

}  // namespace unit_channel_test
}  // namespace stormproof::model
