// Means over strata: intervals by hand, and how often they contain the true mean.
#include "checker/experiments/statistics/stratified.hpp"

#include <cmath>
#include <limits>
#include <random>

#include <gtest/gtest.h>

namespace stormproof::statistics {
namespace stratified_test {

using Strata = std::vector<std::vector<double>>;

/// Two strata with values 1 ± 1 and 10 ± 1: variances 2 and 2, of the means 1 and 1, two degrees of
/// freedom together; t is 4.303 at 97.5 %.
TEST(StratifiedMean, ByHand) {
  const auto mean = stratified_mean({{0, 2}, {9, 11}}, 0.95);
  ASSERT_TRUE(mean);
  EXPECT_DOUBLE_EQ(mean->estimate, 5.5);
  EXPECT_NEAR(mean->high - mean->estimate, 4.3027 * std::sqrt(2.0) / 2, 1e-3);
  EXPECT_NEAR(mean->estimate - mean->low, mean->high - mean->estimate, 1e-12);
}

TEST(StratifiedMean, DoesNotExistWithAnUnreachedValue) {
  EXPECT_FALSE(stratified_mean({{1, std::numeric_limits<double>::infinity()}}, 0.95));
  EXPECT_FALSE(stratified_ratio({{1, 2}}, {{0, 0}}, 0.95));
}

/// What is the same value by value is known exactly, however much the values differ.
TEST(StratifiedRatio, OfProportionalValuesIsExact) {
  const Strata below{{1, 5}, {20, 90}, {7, 3}};
  Strata above = below;
  for (auto& stratum : above) {
    for (double& value : stratum) value *= 1.5;
  }
  const auto ratio = stratified_ratio(above, below, 0.999);
  ASSERT_TRUE(ratio);
  EXPECT_NEAR(ratio->low, 1.5, 1e-12);
  EXPECT_NEAR(ratio->high, 1.5, 1e-12);
}

/// Fifteen strata whose means rise, with heavy tails, as completions of storms have: of 4,000
/// samples of two and of three draws hardly more intervals than 5 % miss the true mean.
TEST(StratifiedMean, MissesTheTrueMeanAsRarelyAsItSays) {
  constexpr int samples = 4'000;
  constexpr double sigma = 0.5;
  std::mt19937_64 random{1};
  std::normal_distribution<double> normal;
  for (const std::size_t draws : {2U, 3U}) {
    int missed = 0;
    for (int k = 0; k < samples; ++k) {
      Strata strata;
      double truth = 0;
      for (int s = 1; s <= 15; ++s) {
        truth += s * std::exp(sigma * sigma / 2) / 15;
        std::vector<double>& stratum = strata.emplace_back();
        for (std::size_t d = 0; d < draws; ++d) {
          stratum.push_back(s * std::exp(sigma * normal(random)));
        }
      }
      const auto mean = stratified_mean(strata, 0.95);
      missed += mean->low > truth || mean->high < truth ? 1 : 0;
    }
    EXPECT_LT(missed, samples * 7 / 100) << draws;
    EXPECT_GT(missed, samples * 2 / 100) << draws << ": the interval is needlessly wide";
  }
}

}  // namespace stratified_test
}  // namespace stormproof::statistics
