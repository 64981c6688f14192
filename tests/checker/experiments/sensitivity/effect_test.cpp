// Medians of differences and their sign-test intervals, with the binomial numbers by hand.
#include "checker/experiments/sensitivity/effect.hpp"

#include <gtest/gtest.h>

namespace stormproof::sensitivity {
namespace effect_test {

std::vector<double> one_to(int n) {
  std::vector<double> values;
  for (int k = n; k >= 1; --k) values.push_back(k);
  return values;
}

TEST(SensitivityEffect, OneDifferenceHasNoInterval) {
  const Effect effect = effect_of({-7});
  EXPECT_EQ(effect.median, -7);
  EXPECT_EQ(effect.low, -7);
  EXPECT_EQ(effect.high, -7);
  EXPECT_EQ(effect.confidence, 0);
  EXPECT_FALSE(effect.exactly_zero);
}

TEST(SensitivityEffect, FiveAreTooFewForNinetyFivePercent) {
  const Effect effect = effect_of(one_to(5));
  EXPECT_EQ(effect.low, 1);
  EXPECT_EQ(effect.high, 5);
  EXPECT_NEAR(effect.confidence, 1 - 2.0 / 32, 1e-12);
}

TEST(SensitivityEffect, TwelveLeaveOutTwoAtEachEnd) {
  const Effect effect = effect_of(one_to(12));
  EXPECT_EQ(effect.median, 6.5);
  EXPECT_EQ(effect.low, 3);
  EXPECT_EQ(effect.high, 10);
  EXPECT_NEAR(effect.confidence, 1 - 2 * (1 + 12 + 66) / 4096.0, 1e-12);
}

TEST(SensitivityEffect, IsClearIfTheIntervalHasOneSign) {
  EXPECT_TRUE(effect_of({1, 2, 3, 4, 5, 6}).is_clear());
  EXPECT_TRUE(effect_of({-1, -2, -3, -4, -5, -6}).is_clear());
  EXPECT_FALSE(effect_of({-1, 2, 3, 4, 5, 6}).is_clear());
  EXPECT_FALSE(effect_of({0, 2, 3, 4, 5, 6}).is_clear());
}

TEST(SensitivityEffect, IsZeroOnlyIfNoPairDiffers) {
  EXPECT_TRUE(effect_of({0, 0, 0}).exactly_zero);
  EXPECT_FALSE(effect_of({0, 0, 1}).exactly_zero);
  EXPECT_FALSE(effect_of({-1, 0, 0}).exactly_zero);
}

}  // namespace effect_test
}  // namespace stormproof::sensitivity
