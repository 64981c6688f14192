// The shift of paired runs, against hand-made samples and against its promise.
#include "checker/experiments/tune/shift.hpp"

#include <random>

#include <gtest/gtest.h>

namespace stormproof::tune {
namespace shift_test {

TEST(TuneShift, MedianOfPairMeans) {
  // Pair means of 1, 2, 6: 1, 1.5, 2, 3.5, 4, 6.
  const Shift shift = shift_of({6, 1, 2});
  EXPECT_DOUBLE_EQ(shift.estimate, 2.75);
  EXPECT_DOUBLE_EQ(shift.low, 1);
  EXPECT_DOUBLE_EQ(shift.high, 6);
  EXPECT_DOUBLE_EQ(shift.confidence, 0.75);  // 1 - 2/2³
  EXPECT_FALSE(shift.is_more());             // three runs prove nothing
}

TEST(TuneShift, SixPairsOfOneSignAreClear) {
  const Shift shift = shift_of({1, 2, 3, 4, 5, 6});
  EXPECT_DOUBLE_EQ(shift.confidence, 1 - 2.0 / 64);
  EXPECT_TRUE(shift.is_more());
  EXPECT_FALSE(shift_of({-1, 2, 3, 4, 5, 6}).is_more());
  EXPECT_TRUE(shift_of({-1, -2, -3, -4, -5, -6}).is_less());
}

TEST(TuneShift, KnownIntervalOfTenPairs) {
  // Tables of the signed-rank test: n = 10, two-sided 5 %: rejected up to rank sum 8.
  std::vector<double> differences;
  for (int k = 1; k <= 10; ++k) differences.push_back(k);
  const Shift shift = shift_of(differences);
  EXPECT_DOUBLE_EQ(shift.estimate, 5.5);
  EXPECT_NEAR(shift.confidence, 1 - 2 * 25.0 / 1024, 1e-12);  // 25 subsets sum to at most 8
  // The ninth least mean, and the ninth greatest: 1, 1.5, 2, 2, 2.5, 2.5, 3, 3, 3.
  EXPECT_DOUBLE_EQ(shift.low, 3);
  EXPECT_DOUBLE_EQ(shift.high, 8);
}

TEST(TuneShift, IntervalMissesTheCentreAsRarelyAsItSays) {
  std::mt19937_64 random{7};
  int missed = 0;
  constexpr int trials = 2'000;
  for (int trial = 0; trial < trials; ++trial) {
    std::vector<double> differences;
    for (int k = 0; k < 20; ++k) {
      const double unit = static_cast<double>(random() >> 11U) * 0x1p-53;
      differences.push_back(unit - 0.5);
    }
    const Shift shift = shift_of(differences);
    if (shift.low > 0 || shift.high < 0) ++missed;
  }
  EXPECT_LT(missed, trials * 7 / 100);
  EXPECT_GT(missed, trials * 3 / 100);
}

TEST(TuneShift, ManyPairsAreCloseToCountedOnes) {
  std::vector<double> differences;
  for (int k = 0; k < 120; ++k) differences.push_back(k % 7 - 2);
  const Shift counted = shift_of(differences);
  differences.push_back(1);
  const Shift normal = shift_of(differences);
  EXPECT_NEAR(counted.low, normal.low, 0.5);
  EXPECT_NEAR(counted.high, normal.high, 0.5);
}

}  // namespace shift_test
}  // namespace stormproof::tune
