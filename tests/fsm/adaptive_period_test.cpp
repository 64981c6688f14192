// The arithmetic of the response-aware policy at its edges: rounding half up, the floor ε of the
// response share, both bounds of the period, and the size of a batch.
#include "fsm/adaptive_period.hpp"

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

namespace stormproof::fsm {
namespace adaptive_period_test {

using Cycle = AdaptiveCycle<Plain>;

Cycle cycle(std::int64_t period, std::int64_t contacted, std::int64_t responded) {
  Cycle c;
  c.period = period;
  c.contacted = contacted;
  c.responded = responded;
  c.min_period = 100;
  c.max_period = 3'000;
  return c;
}

std::int64_t stretched(std::int64_t period, std::int64_t contacted, std::int64_t responded) {
  return stretched_period<Plain>(cycle(period, contacted, responded));
}

TEST(AdaptivePeriod, ScalingRoundsToNearestAndHalvesUp) {
  EXPECT_EQ(scaled<Plain>(7, 1, 2), 4);  // 3.5
  EXPECT_EQ(scaled<Plain>(5, 1, 2), 3);  // 2.5
  EXPECT_EQ(scaled<Plain>(4, 1, 3), 1);  // 1.33
  EXPECT_EQ(scaled<Plain>(5, 1, 3), 2);  // 1.67
  EXPECT_EQ(scaled<Plain>(0, 9, 4), 0);
  EXPECT_EQ(scaled<Plain>(6, 2, 3), 4);
}

TEST(AdaptivePeriod, StretchesByTheShareOfReadersThatResponded) {
  EXPECT_EQ(stretched(200, 4, 4), 200);
  EXPECT_EQ(stretched(200, 4, 2), 400);
  EXPECT_EQ(stretched(200, 3, 2), 300);
  EXPECT_EQ(stretched(101, 2, 1), 202);
  EXPECT_EQ(stretched(101, 3, 2), 152);  // 151.5
  EXPECT_EQ(stretched(100, 3, 2), 150);
}

TEST(AdaptivePeriod, BelowTheFloorTheShareIsTheFloor) {
  EXPECT_EQ(stretched(100, 20, 1), 2'000);  // 1/20 is just enough: 100·20/1
  EXPECT_EQ(stretched(100, 21, 1), 2'000);  // 1/21 is not: the floor, 100·20
  EXPECT_EQ(stretched(100, 1, 0), 2'000);
  EXPECT_EQ(stretched(100, 1'000, 0), 2'000);
}

TEST(AdaptivePeriod, NeverLongerThanTheUpperBound) {
  EXPECT_EQ(stretched(200, 20, 1), 3'000);
  EXPECT_EQ(stretched(151, 1, 0), 3'000);
  EXPECT_EQ(stretched(150, 1, 0), 3'000);
  EXPECT_EQ(stretched(149, 1, 0), 2'980);
}

TEST(AdaptivePeriod, NeverShorterThanItWas) {
  EXPECT_EQ(stretched(5'000, 2, 1), 5'000);  // above the bound already: it stays
  EXPECT_EQ(stretched(50, 2, 2), 100);       // below the lower bound: raised to it
}

TEST(AdaptivePeriod, ClampingIsToBothBounds) {
  const Cycle c = cycle(0, 1, 1);
  EXPECT_EQ(clamped_period<Plain>(c, 99), 100);
  EXPECT_EQ(clamped_period<Plain>(c, 100), 100);
  EXPECT_EQ(clamped_period<Plain>(c, 3'000), 3'000);
  EXPECT_EQ(clamped_period<Plain>(c, 3'001), 3'000);
}

TEST(AdaptivePeriod, ABatchHasAsManyReadersAsRespondedButAtLeastTheFloorOfTheContacted) {
  EXPECT_EQ(batch_size<Plain>(cycle(1, 1, 0)), 1);
  EXPECT_EQ(batch_size<Plain>(cycle(1, 20, 0)), 1);
  EXPECT_EQ(batch_size<Plain>(cycle(1, 21, 0)), 2);  // ⌈21/20⌉
  EXPECT_EQ(batch_size<Plain>(cycle(1, 40, 0)), 2);
  EXPECT_EQ(batch_size<Plain>(cycle(1, 41, 2)), 3);
  EXPECT_EQ(batch_size<Plain>(cycle(1, 41, 7)), 7);
}

RC_GTEST_PROP(AdaptivePeriod, StaysBetweenItsOldValueAndTheUpperBound, ()) {
  const auto period = *rc::gen::inRange<std::int64_t>(100, 3'001);
  const auto contacted = *rc::gen::inRange<std::int64_t>(1, 500);
  const auto responded = *rc::gen::inRange<std::int64_t>(0, contacted + 1);
  const std::int64_t after = stretched(period, contacted, responded);
  RC_ASSERT(after >= period);
  RC_ASSERT(after <= 3'000);
}

RC_GTEST_PROP(AdaptivePeriod, MoreResponsesNeverLengthenIt, ()) {
  const auto period = *rc::gen::inRange<std::int64_t>(100, 3'001);
  const auto contacted = *rc::gen::inRange<std::int64_t>(1, 500);
  const auto responded = *rc::gen::inRange<std::int64_t>(0, contacted);
  RC_ASSERT(stretched(period, contacted, responded + 1) <= stretched(period, contacted, responded));
}

}  // namespace adaptive_period_test
}  // namespace stormproof::fsm
