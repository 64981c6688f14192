// The paired test against the binomial table, against differences by hand, and against its promise:
// an interval that claims 95 % has to contain the true median that often.
#include "checker/experiments/statistics/paired.hpp"

#include <cmath>
#include <random>

#include <gtest/gtest.h>

#include "checker/experiments/statistics/completion.hpp"

namespace stormproof::statistics {
namespace paired_test {

constexpr double nan = std::numeric_limits<double>::quiet_NaN();

PairedDifferences pairs_of(const std::vector<double>& differences) {
  PairedDifferences pairs;
  for (const double difference : differences) pairs.add(difference);
  return pairs;
}
Shift shift_of(const std::vector<double>& differences, double confidence = 0.95) {
  return pairs_of(differences).shift(confidence);
}

TEST(SignInterval, BinomialTable) {
  // n = 9: P(B ≤ 1) = 10/512, so (2, 8) has 96.09 %; n = 10: (2, 9) has 97.85 %.
  EXPECT_EQ(sign_interval(9, 0.95).rank, 2U);
  EXPECT_NEAR(sign_interval(9, 0.95).confidence, 1 - 20.0 / 512, 1e-12);
  EXPECT_EQ(sign_interval(10, 0.95).rank, 2U);
  EXPECT_NEAR(sign_interval(10, 0.95).confidence, 1 - 22.0 / 1024, 1e-12);
  EXPECT_EQ(sign_interval(12, 0.95).rank, 3U);
  EXPECT_NEAR(sign_interval(12, 0.95).confidence, 1 - 2 * (1 + 12 + 66) / 4096.0, 1e-12);
  EXPECT_EQ(sign_interval(20, 0.95).rank, 6U);
  EXPECT_EQ(sign_interval(40, 0.95).rank, 14U);
  EXPECT_NEAR(sign_interval(1, 0.95).confidence, 0, 1e-12);
}

TEST(SignInterval, TooFewReachLessThanWanted) {
  EXPECT_EQ(sign_interval(5, 0.95).rank, 1U);
  EXPECT_NEAR(sign_interval(5, 0.95).confidence, 1 - 2.0 / 32, 1e-12);
  EXPECT_EQ(sign_interval(12, 0.9997).rank, 1U);
  EXPECT_LT(sign_interval(12, 0.9997).confidence, 0.9997);
}

TEST(SignInterval, FewestPairs) {
  // 1 − 2^(1 − n) ≥ confidence.
  EXPECT_EQ(fewest_pairs(0.5), 2U);
  EXPECT_EQ(fewest_pairs(0.95), 6U);
  EXPECT_EQ(fewest_pairs(0.99), 8U);
  EXPECT_EQ(fewest_pairs(1 - 0.025 / 81), 13U);  // nine configurations, three looks
}

TEST(PairedDifferences, TwelveLeaveOutTwoAtEachEnd) {
  const Shift shift = shift_of({12, 11, 10, 9, 8, 7, 6, 5, 4, 3, 2, 1});
  EXPECT_EQ(shift.estimate, 6.5);
  EXPECT_EQ(shift.low, 3);
  EXPECT_EQ(shift.high, 10);
  EXPECT_NEAR(shift.confidence, 1 - 158.0 / 4096, 1e-12);
}

TEST(PairedDifferences, KnowTheDirectionFromSixPairsOn) {
  EXPECT_TRUE(shift_of({1, 2, 3, 4, 5, 6}).is_more());
  EXPECT_TRUE(shift_of({-1, -2, -3, -4, -5, -6}).is_less());
  EXPECT_FALSE(shift_of({-1, 2, 3, 4, 5, 6}).is_more());
  EXPECT_FALSE(shift_of({0, 2, 3, 4, 5, 6}).is_more());
  EXPECT_FALSE(shift_of({1, 2, 3, 4, 5}).is_more());
}

TEST(PairedDifferences, OneIsAFactIfItStandsForAll) {
  EXPECT_EQ(pairs_of({-7}).fact(), (Shift{-7, -7, -7, 1, true}));
  EXPECT_TRUE(pairs_of({-7}).fact().is_less());
  EXPECT_FALSE(pairs_of({-7}).shift().is_less());
  EXPECT_EQ(pairs_of({-7}).shift().confidence, 0);
}

TEST(PairedDifferences, AreAllZeroOnlyIfNoPairDiffers) {
  EXPECT_TRUE(pairs_of({0, 0, 0}).all_zero());
  EXPECT_FALSE(pairs_of({0, 0, 1}).all_zero());
  EXPECT_FALSE(pairs_of({-1, 0, 0}).all_zero());
  EXPECT_FALSE(pairs_of({0, nan}).all_zero());
}

TEST(RelativeChange, OfZeroAndOfRunsThatDoNotComplete) {
  EXPECT_EQ(relative_change(2, 3), 0.5);
  EXPECT_EQ(relative_change(0, 0), 0);
  EXPECT_EQ(relative_change(0, 5), unreached);
  EXPECT_EQ(relative_change(5, unreached), unreached);
  EXPECT_EQ(relative_change(unreached, 5), -1);
  EXPECT_TRUE(std::isnan(relative_change(unreached, unreached)));
}

TEST(PairedDifferences, QuotientsByHand) {
  PairedDifferences pairs;
  for (const double value : {10, 20, 40, 80, 160, 320}) pairs.add_relative(value, 3 * value);
  const Shift shift = pairs.shift();
  EXPECT_NEAR(shift.estimate, 2, 1e-12);
  EXPECT_NEAR(shift.low, 2, 1e-12);
  EXPECT_NEAR(shift.high, 2, 1e-12);
}

TEST(PairedDifferences, RunsThatDoNotComplete) {
  const std::vector<double> all{1, 2, 3, 4, 5, 6};
  PairedDifferences lost, regained, neither, neither_relative;
  for (const double value : all) {
    lost.add_relative(value, unreached);
    regained.add_relative(unreached, value);
    neither.add(unreached - unreached);
    neither_relative.add_relative(unreached, unreached);
  }
  EXPECT_EQ(lost.shift().low, unreached);
  EXPECT_TRUE(lost.shift().is_more());
  EXPECT_EQ(regained.shift().high, -1);
  // Nothing is known of two runs that both do not complete: neither better nor worse.
  EXPECT_EQ(neither.shift().low, -unreached);
  EXPECT_EQ(neither.shift().high, unreached);
  EXPECT_EQ(neither.shift().estimate, 0);
  EXPECT_EQ(neither_relative.shift().low, -1);
  EXPECT_EQ(neither_relative.shift().high, unreached);
}

TEST(PairedDifferences, BetweenBoundsOnlyTheSureEndCounts) {
  constexpr double infinity = std::numeric_limits<double>::infinity();
  PairedDifferences at_least;
  for (int k = 0; k < 6; ++k) at_least.add_between(2, infinity);
  const Shift more = at_least.shift();
  EXPECT_EQ(more.estimate, 2);
  EXPECT_EQ(more.low, 2);
  EXPECT_EQ(more.high, infinity);
  EXPECT_TRUE(more.is_more());
  PairedDifferences nothing;
  for (int k = 0; k < 6; ++k) nothing.add_between(-infinity, infinity);
  EXPECT_EQ(nothing.shift().estimate, 0);
  EXPECT_FALSE(nothing.shift().is_more() || nothing.shift().is_less());
  EXPECT_FALSE(nothing.all_zero());
}

TEST(PairedDifferences, OneUnknownPairOfTwelveWidensTheIntervalByOne) {
  // Ranks 3 and 10 of −∞ 2 … 12, and of 2 … 12 +∞; the median of 0 2 … 12.
  const Shift shift = shift_of({nan, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11, 12});
  EXPECT_EQ(shift.low, 3);
  EXPECT_EQ(shift.high, 11);
  EXPECT_EQ(shift.estimate, 6.5);
}

/// Share of 2,000 drawn experiments of n pairs whose interval contains the true median difference.
template <class Difference>
double coverage(std::size_t n, double median, Difference difference) {
  std::mt19937_64 random{42};
  constexpr int experiments = 2'000;
  int covered = 0;
  for (int k = 0; k < experiments; ++k) {
    PairedDifferences pairs;
    for (std::size_t pair = 0; pair < n; ++pair) pairs.add(difference(random));
    const Shift found = pairs.shift();
    covered += found.low <= median && median <= found.high ? 1 : 0;
  }
  return covered / static_cast<double>(experiments);
}

TEST(PairedDifferences, CoverTheTrueMedianAsOftenAsTheyClaim) {
  std::normal_distribution<double> normal{0.7, 1};
  std::lognormal_distribution<double> skewed{0, 1};  // its median is 1
  const auto even = [&](auto& random) { return normal(random); };
  const auto uneven = [&](auto& random) { return skewed(random); };
  EXPECT_GE(coverage(12, 0.7, even), 0.95);
  EXPECT_GE(coverage(12, 1, uneven), 0.95);
  EXPECT_GE(coverage(40, 1, uneven), 0.95);
  EXPECT_LE(coverage(12, 1, uneven), 0.98);   // and it is not just wide: 96.1 %
  EXPECT_LT(coverage(40, 1.4, uneven), 0.9);  // what it claims can be missed
}

TEST(PairedDifferences, ForgetWhatBothRunsOfAPairShare) {
  // Storms that differ by a factor of 50 from seed to seed, and a setting that makes each of them
  // 20 % longer: pair by pair that is clear.
  std::mt19937_64 random{3};
  std::lognormal_distribution<double> storm{20, 1};
  PairedDifferences pairs;
  for (int k = 0; k < 12; ++k) {
    const double before = storm(random);
    pairs.add_relative(before, 1.2 * before);
  }
  EXPECT_TRUE(pairs.shift().is_more());
  EXPECT_NEAR(pairs.shift().estimate, 0.2, 1e-9);
}

}  // namespace paired_test
}  // namespace stormproof::statistics
