// Rank-sum and sign intervals against hand-computed and published cases, and their coverage by
// simulation: an interval that claims 95 % has to contain the true shift that often.
#include "checker/experiments/diff/shift.hpp"

#include <cmath>
#include <limits>
#include <random>

#include <gtest/gtest.h>

namespace stormproof::diff {
namespace shift_test {

constexpr double infinity = std::numeric_limits<double>::infinity();

TEST(RankSumInterval, SmallCasesByHand) {
  // Three against three: 20 orders, W = 0 in one of them, so (1, 9) has 1 − 2/20.
  const IntervalRank three = rank_sum_interval(3, 3, 0.9);
  EXPECT_EQ(three.rank, 1U);
  EXPECT_NEAR(three.confidence, 0.9, 1e-12);
  // 2 against 2: six orders; P(W < 1) = 1/6, P(W < 2) = 2/6.
  const IntervalRank two = rank_sum_interval(2, 2, 0.3);
  EXPECT_EQ(two.rank, 2U);
  EXPECT_NEAR(two.confidence, 1.0 / 3, 1e-12);
  // One against one says nothing.
  EXPECT_NEAR(rank_sum_interval(1, 1, 0.95).confidence, 0, 1e-12);
}

TEST(RankSumInterval, PublishedCriticalValues) {
  // Two-sided 5 % critical values of the Mann–Whitney U (every textbook's table): U ≤ 23 for 10 and
  // 10, U ≤ 2 for 5 and 5, U ≤ 37 for 12 and 12, U ≤ 127 for 20 and 20; k is one more.
  EXPECT_EQ(rank_sum_interval(10, 10, 0.95).rank, 24U);
  EXPECT_EQ(rank_sum_interval(5, 5, 0.95).rank, 3U);
  EXPECT_EQ(rank_sum_interval(12, 12, 0.95).rank, 38U);
  EXPECT_EQ(rank_sum_interval(20, 20, 0.95).rank, 128U);
  EXPECT_EQ(rank_sum_interval(5, 10, 0.95).rank, 9U);
  EXPECT_EQ(rank_sum_interval(10, 5, 0.95).rank, 9U);
}

TEST(RankSumInterval, TooFewReachLessThanWanted) {
  const IntervalRank rank = rank_sum_interval(3, 3, 0.95);
  EXPECT_EQ(rank.rank, 1U);
  EXPECT_LT(rank.confidence, 0.95);
}

TEST(RankSumInterval, ApproximationContinuesTheExactOne) {
  const IntervalRank exact = rank_sum_interval(exact_rank_sum, exact_rank_sum, 0.95);
  const IntervalRank approximate = rank_sum_interval(exact_rank_sum + 1, exact_rank_sum, 0.95);
  EXPECT_NEAR(static_cast<double>(approximate.rank), static_cast<double>(exact.rank), 25);
  EXPECT_NEAR(approximate.confidence, 0.95, 0.002);
  EXPECT_GE(exact.confidence, 0.95);
}

TEST(SignInterval, BinomialTable) {
  // n = 9: P(B ≤ 1) = 10/512, so (2, 8) has 96.09 %; n = 10: (2, 9) has 97.85 %.
  EXPECT_EQ(sign_interval(9, 0.95).rank, 2U);
  EXPECT_NEAR(sign_interval(9, 0.95).confidence, 1 - 20.0 / 512, 1e-12);
  EXPECT_EQ(sign_interval(10, 0.95).rank, 2U);
  EXPECT_NEAR(sign_interval(10, 0.95).confidence, 1 - 22.0 / 1024, 1e-12);
  EXPECT_EQ(sign_interval(20, 0.95).rank, 6U);
  EXPECT_NEAR(sign_interval(1, 0.95).confidence, 0, 1e-12);
}

TEST(ShiftEstimator, ByHand) {
  ShiftEstimator estimator;
  const auto shift = estimator.between({1, 2, 3}, {4, 6, 9}, 0.9);
  ASSERT_TRUE(shift);
  // Differences: 1 2 3 3 4 5 6 7 8.
  EXPECT_EQ(shift->estimate, 4);
  EXPECT_EQ(shift->low, 1);
  EXPECT_EQ(shift->high, 8);
  EXPECT_NEAR(shift->confidence, 0.9, 1e-12);
  EXPECT_FALSE(estimator.between({}, {1}, 0.9));
  EXPECT_FALSE(estimator.between({1}, {}, 0.9));
}

TEST(ShiftEstimator, PublishedExample) {
  // Hollander and Wolfe, table 4.1 (permeability of the human chorioamnion): estimate −0.305.
  const std::vector<double> at_term{0.80, 0.83, 1.89, 1.04, 1.45, 1.38, 1.91, 1.64, 0.73, 1.46};
  const std::vector<double> earlier{1.15, 0.88, 0.90, 0.74, 1.21};
  ShiftEstimator estimator;
  const auto shift = estimator.between(at_term, earlier, 0.95);
  ASSERT_TRUE(shift);
  EXPECT_NEAR(shift->estimate, -0.305, 1e-9);
  EXPECT_LT(shift->low, -0.305);
  EXPECT_GT(shift->high, 0);
}

TEST(ShiftEstimator, RatiosAreAShiftOfLogarithms) {
  ShiftEstimator estimator;
  const std::vector<double> before{10, 20, 40, 80};
  std::vector<double> after;
  for (const double value : before) after.push_back(3 * value);
  const auto ratio = estimator.ratio(before, after, 0.9);
  ASSERT_TRUE(ratio);
  EXPECT_NEAR(ratio->estimate, 2, 1e-12);
  EXPECT_GE(ratio->low, -1);
  EXPECT_EQ(relative_change(0, 0), 0);
  EXPECT_EQ(relative_change(0, 5), infinity);
  EXPECT_EQ(relative_change(infinity, 5), -1);
}

TEST(ShiftEstimator, RunsThatDoNotComplete) {
  ShiftEstimator estimator;
  const std::vector<double> all{1, 2, 3, 4, 5, 6};
  const std::vector<double> never(6, infinity);
  const auto lost = estimator.ratio(all, never, 0.95);
  EXPECT_EQ(lost->low, infinity);
  const auto regained = estimator.ratio(never, all, 0.95);
  EXPECT_EQ(regained->high, -1);
  // Nothing is known of two runs that both do not complete: neither better nor worse.
  const auto unknown = estimator.between(never, never, 0.95);
  EXPECT_EQ(unknown->low, -infinity);
  EXPECT_EQ(unknown->high, infinity);
  EXPECT_EQ(unknown->estimate, 0);
  const auto ratio = estimator.ratio(never, never, 0.95);
  EXPECT_EQ(ratio->low, -1);
  EXPECT_EQ(ratio->high, infinity);
}

/// Share of 2,000 drawn experiments whose interval contains the true shift.
double coverage(std::size_t m, std::size_t n, bool heavy_tails) {
  std::mt19937_64 random{42};
  std::lognormal_distribution<double> skewed{0, 1};
  std::normal_distribution<double> normal;
  ShiftEstimator estimator;
  constexpr double shift = 0.7;
  constexpr int experiments = 2'000;
  int covered = 0;
  for (int k = 0; k < experiments; ++k) {
    const auto draw = [&] { return heavy_tails ? skewed(random) : normal(random); };
    std::vector<double> before(m);
    std::vector<double> after(n);
    for (double& value : before) value = draw();
    for (double& value : after) value = draw() + shift;
    const auto found = estimator.between(before, after, 0.95);
    covered += found->low <= shift && shift <= found->high ? 1 : 0;
  }
  return covered / static_cast<double>(experiments);
}

TEST(ShiftEstimator, CoversTheTrueShiftAsOftenAsItClaims) {
  EXPECT_GE(coverage(12, 12, false), 0.93);
  EXPECT_GE(coverage(12, 12, true), 0.93);
  EXPECT_GE(coverage(5, 20, true), 0.93);
  EXPECT_LE(coverage(12, 12, true), 0.98);  // and it is not just wide
}

TEST(ShiftEstimator, WhatItClaimsCanBeMissed) {
  // The same experiments against an interval that is too narrow by its rank: it covers less.
  std::mt19937_64 random{7};
  std::normal_distribution<double> normal;
  int covered = 0;
  for (int k = 0; k < 500; ++k) {
    PairwiseChanges changes;
    std::vector<double> before(12);
    for (double& value : before) value = normal(random);
    for (int j = 0; j < 12; ++j) {
      const double after = normal(random);
      for (const double value : before) changes.add(value, after, false);
    }
    const Shift shift = changes.shift({60, 0});
    covered += shift.low <= 0 && 0 <= shift.high ? 1 : 0;
  }
  EXPECT_LT(covered, 350);
}

}  // namespace shift_test
}  // namespace stormproof::diff
