// The interval against published values, against its definition, and at its ends.
#include "checker/experiments/statistics/confidence.hpp"

#include <cmath>

#include <gtest/gtest.h>

namespace stormproof::statistics {
namespace confidence_test {

TEST(ClopperPearson, known_values) {
  const RateInterval none = clopper_pearson(0, 200);
  EXPECT_EQ(none.low, 0);
  EXPECT_NEAR(none.high, 0.0183, 0.00005);
  const RateInterval some = clopper_pearson(5, 100);
  EXPECT_NEAR(some.low, 0.0164, 0.00005);
  EXPECT_NEAR(some.high, 0.1128, 0.00005);
  const RateInterval half = clopper_pearson(5, 10);
  EXPECT_NEAR(half.low, 0.1871, 0.00005);
  EXPECT_NEAR(half.high, 0.8129, 0.00005);
}

TEST(ClopperPearson, ends) {
  const RateInterval all = clopper_pearson(200, 200);
  EXPECT_EQ(all.high, 1);
  EXPECT_NEAR(all.low, std::pow(0.025, 1.0 / 200), 1e-12);
  const RateInterval single = clopper_pearson(0, 1);
  EXPECT_NEAR(single.high, 0.975, 1e-12);
  const RateInterval nothing = clopper_pearson(0, 0);
  EXPECT_EQ(nothing.low, 0);
  EXPECT_EQ(nothing.high, 1);
  EXPECT_NEAR(clopper_pearson(0, 100, 0.9).high, 1 - std::pow(0.05, 0.01), 1e-12);
}

/// Probability of at least `hits` of `runs` at `rate`, summed term by term.
double at_least(int hits, int runs, double rate) {
  double sum = 0;
  for (int k = hits; k <= runs; ++k) {
    sum += std::exp(std::lgamma(runs + 1) - std::lgamma(k + 1) - std::lgamma(runs - k + 1) +
                    k * std::log(rate) + (runs - k) * std::log1p(-rate));
  }
  return sum;
}

TEST(ClopperPearson, bounds_have_the_tails_of_the_definition) {
  for (const int runs : {3, 20, 77}) {
    for (int hits = 1; hits < runs; hits += 1 + runs / 10) {
      const RateInterval interval =
          clopper_pearson(static_cast<std::size_t>(hits), static_cast<std::size_t>(runs));
      EXPECT_NEAR(at_least(hits, runs, interval.low), 0.025, 1e-9) << hits << "/" << runs;
      EXPECT_NEAR(1 - at_least(hits + 1, runs, interval.high), 0.025, 1e-9) << hits << "/" << runs;
    }
  }
}

}  // namespace confidence_test
}  // namespace stormproof::statistics
