// Quantiles by hand, with runs that did not complete.
#include "checker/experiments/statistics/quantiles.hpp"

#include <gtest/gtest.h>

namespace stormproof::statistics {
namespace quantiles_test {

TEST(Completion, IsAboveEveryOtherIfItIsNotReached) {
  EXPECT_EQ(completion_ns(model::Nanoseconds{1'500}), 1'500);
  EXPECT_GT(completion_ns(std::nullopt), completion_ns(model::Nanoseconds{INT64_MAX}));
}

TEST(Quantile, LiesBetweenTheSortedValues) {
  const std::vector<double> values{40, 10, 30, 20};
  EXPECT_EQ(quantile(values, 0), 10);
  EXPECT_EQ(quantile(values, 1), 40);
  EXPECT_EQ(median(values), 25);
  EXPECT_DOUBLE_EQ(quantile(values, 0.1), 13);     // position 0.3
  EXPECT_DOUBLE_EQ(quantile(values, 0.75), 32.5);  // position 2.25
  EXPECT_EQ(median({7}), 7);
}

TEST(Quantile, IsUnreachedBesideAnUnreachedValue) {
  EXPECT_EQ(median({1, unreached}), unreached);
  EXPECT_EQ(median({1, 2, unreached}), 2);
  EXPECT_EQ(quantile({1, 2, unreached}, 0.6), unreached);
  EXPECT_EQ(median({unreached, unreached}), unreached);
  EXPECT_EQ(median({-unreached, 3}), -unreached);
  EXPECT_EQ(median({-unreached, unreached}), 0);  // nobody knows
}

TEST(Quantiles, OfCompleteRuns) {
  const Quantiles q = quantiles({5, 1, 4, 2, 3});
  EXPECT_EQ(q.count, 5U);
  EXPECT_EQ(q.min, 1);
  EXPECT_DOUBLE_EQ(*q.p10, 1.4);
  EXPECT_EQ(q.median, 3);
  EXPECT_DOUBLE_EQ(*q.p90, 4.6);
  EXPECT_EQ(q.max, 5);
}

TEST(Quantiles, ThatFallAmongUnreachedRunsDoNotExist) {
  const Quantiles some = quantiles({unreached, 1, 2, 3, unreached});
  EXPECT_EQ(some.count, 5U);
  EXPECT_EQ(some.min, 1);
  EXPECT_EQ(some.median, 3);
  EXPECT_FALSE(some.p90);
  EXPECT_FALSE(some.max);
  const Quantiles none = quantiles({unreached, unreached});
  EXPECT_EQ(none.count, 2U);
  EXPECT_FALSE(none.min);
  EXPECT_FALSE(quantiles({}).median);
  EXPECT_EQ(quantiles({}).count, 0U);
}

}  // namespace quantiles_test
}  // namespace stormproof::statistics
