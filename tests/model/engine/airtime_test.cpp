// Fragments and airtimes at the sizes where something changes, by hand-computed numbers.
#include "model/airtime.hpp"

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

namespace stormproof::model {
namespace airtime_test {

TEST(Fragmentation, APacketOfOneMtuIsOneFragment) {
  const Fragmentation f{WirelessProfile{}};
  EXPECT_EQ(f.count(1'472), 1);
  EXPECT_EQ(f.bytes(1'472, 0), 1'480 + 20 + 38);
  EXPECT_EQ(f.demand(1'472, 1), 1'538);
}

TEST(Fragmentation, OneByteMoreIsAFragmentMore) {
  const Fragmentation f{WirelessProfile{}};
  EXPECT_EQ(f.count(1'473), 2);
  EXPECT_EQ(f.bytes(1'473, 0), 1'538);
  EXPECT_EQ(f.bytes(1'473, 1), 1 + 58);
  EXPECT_EQ(f.demand(1'473, 2), 1'538 + 59);
}

TEST(Fragmentation, ExactMultiplesHaveNoEmptyFragment) {
  const Fragmentation f{WirelessProfile{}};
  EXPECT_EQ(f.count(2 * 1'480 - 8), 2);
  EXPECT_EQ(f.bytes(2 * 1'480 - 8, 1), 1'538);
  EXPECT_EQ(f.count(65'500), 45);
  EXPECT_EQ(f.count(0), 1);
}

RC_GTEST_PROP(Fragmentation, FragmentsAddUpToTheDemand, ()) {
  WirelessProfile wireless;
  wireless.mtu_payload_bytes = Bytes{*rc::gen::inRange<std::int64_t>(8, 3'000)};
  wireless.link_overhead_bytes = Bytes{*rc::gen::inRange<std::int64_t>(0, 100)};
  const auto payload = *rc::gen::inRange<std::int64_t>(1, 70'000);
  const Fragmentation f{wireless};
  const std::int64_t count = f.count(payload);
  const std::int64_t header = 20 + wireless.link_overhead_bytes.count();
  std::int64_t sum = 0;
  for (std::int64_t k = 0; k < count; ++k) {
    RC_ASSERT(f.bytes(payload, k) > header);
    RC_ASSERT(f.bytes(payload, k) <= header + wireless.mtu_payload_bytes.count());
    sum += f.bytes(payload, k);
  }
  RC_ASSERT(sum == f.demand(payload, count));
  RC_ASSERT(sum == payload + 8 + header * count);
}

TEST(ServiceRate, AirtimeIsOverheadPlusBitsRoundedToNearest) {
  const ServiceRate unicast{194'500, 144'400'000};
  EXPECT_EQ(unicast.airtime_ns(134), 194'500 + 7'424);     // 7423.8
  EXPECT_EQ(unicast.airtime_ns(1'538), 194'500 + 85'208);  // 85207.8
  const ServiceRate multicast{130'500, 6'000'000};
  EXPECT_EQ(multicast.airtime_ns(486), 130'500 + 648'000);
}

TEST(ServiceRate, AHalfIsRoundedUp) {
  EXPECT_EQ((ServiceRate{0, 16'000'000'000}.airtime_ns(1)), 1);  // 0.5
  EXPECT_EQ((ServiceRate{0, 16'000'000'001}.airtime_ns(1)), 0);
  EXPECT_EQ((ServiceRate{0, 16'000'000'000}.airtime_ns(3)), 2);  // 1.5
  EXPECT_EQ((ServiceRate{0, 3'000'000'000}.airtime_ns(1)), 3);   // 2.67
  EXPECT_EQ((ServiceRate{5, 8'000'000'000}.airtime_ns(7)), 12);
}

RC_GTEST_PROP(ServiceRate, MemoizingChangesNothing, ()) {
  const ServiceRate rate{*rc::gen::inRange<std::int64_t>(0, 1'000'000),
                         *rc::gen::inRange<std::int64_t>(1, 1'000'000'000)};
  MemoizedRate memoized{rate};
  for (const std::int64_t bytes :
       *rc::gen::container<std::vector<std::int64_t>>(rc::gen::inRange<std::int64_t>(0, 4))) {
    RC_ASSERT(memoized.airtime_ns(bytes) == rate.airtime_ns(bytes));
  }
}

TEST(ServiceRate, TheModeOfAPacketDependsOnTheStage) {
  const WirelessProfile wireless;
  const auto overhead = [&](std::size_t stage, bool multicast) {
    return service_rate(wireless, wireless.stages[stage], multicast).overhead_ns;
  };
  EXPECT_EQ(overhead(0, false), 194'500);
  EXPECT_EQ(overhead(0, true), 194'500);  // to the access point as unicast
  EXPECT_EQ(overhead(1, false), 194'500);
  EXPECT_EQ(overhead(1, true), 130'500);
}

TEST(ServiceRate, AStageMayOverrideEachValueAlone) {
  WirelessProfile wireless;
  Stage& stage = wireless.stages[1];
  stage.overhead_multicast = Nanoseconds{1};
  stage.rate_unicast = BitsPerSecond{2};
  EXPECT_EQ(service_rate(wireless, stage, true).overhead_ns, 1);
  EXPECT_EQ(service_rate(wireless, stage, true).bits_per_second, 6'000'000);
  EXPECT_EQ(service_rate(wireless, stage, false).overhead_ns, 194'500);
  EXPECT_EQ(service_rate(wireless, stage, false).bits_per_second, 2);
}

}  // namespace airtime_test
}  // namespace stormproof::model
