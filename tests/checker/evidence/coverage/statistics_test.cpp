// Each statistic on numbers whose result can be seen.
#include <cmath>

#include <gtest/gtest.h>

#include "examples.hpp"

namespace stormproof::prediction {
namespace statistics_test {

/// The fit of one configuration.
Fit fit_of(const std::vector<double>& measured, const std::vector<double>& model) {
  const Configuration configuration = configuration_of(measured);
  const Prediction prediction = prediction_of(model);
  return *fit({{&configuration, &prediction}}, "all", Measure::completion);
}

TEST(Statistics, CoverageIsTheShareOfRunsUpToTheModel) {
  const Fit f = fit_of({5, 10, 20, 40}, {10});
  EXPECT_EQ(f.coverage, 0.5);
  EXPECT_EQ(f.covered_median, 1.5);  // of 10/10 and 10/5
  EXPECT_EQ(f.covered_q1, 1.25);
  EXPECT_EQ(f.covered_q3, 1.75);
}

TEST(Statistics, RatioOfAConfigurationIsThatOfMedians) {
  const Fit f = fit_of({10, 20, 90}, {5, 10, 900});
  EXPECT_EQ(f.median_ratio, 0.5);
  EXPECT_DOUBLE_EQ(*f.median_abs_ln_ratio, std::log(2));
  EXPECT_EQ(f.mean_absolute_percent, 50);
}

TEST(Statistics, MedianOverConfigurations) {
  const std::vector<Configuration> observed{configuration_of({10}), configuration_of({10}, 2),
                                            configuration_of({10}, 3)};
  const std::vector<Prediction> predicted{prediction_of({10}), prediction_of({20}),
                                          prediction_of({40})};
  std::vector<Pairing> pairings;
  for (std::size_t k = 0; k < 3; ++k) pairings.push_back({&observed[k], &predicted[k]});
  EXPECT_EQ(fit(pairings, "all", Measure::completion)->median_ratio, 2);
  EXPECT_EQ(fit(pairings, "np3", Measure::completion)->median_ratio, 4);
  EXPECT_FALSE(fit(pairings, "high_load", Measure::completion));
  EXPECT_FALSE(fit(pairings, "all", Measure::heartbeat));  // was not measured
  EXPECT_EQ(scopes(pairings), (std::vector<std::string>{"np1", "np2", "np3", "all"}));
}

TEST(Statistics, ScopesOfFleetsAndOfSpreadStarts) {
  std::vector<Configuration> observed{configuration_of({10}), configuration_of({10})};
  observed[1].hosts = 5;
  observed[1].spread.step_ms = 20;
  const Prediction predicted = prediction_of({20});
  const std::vector<Pairing> pairings{{&observed[0], &predicted}, {&observed[1], &predicted}};
  EXPECT_EQ(scopes(pairings), (std::vector<std::string>{"np1", "nh2", "nh5", "all", "spread"}));
  EXPECT_EQ(fit(pairings, "nh5", Measure::completion)->configurations, 1U);
  EXPECT_EQ(fit(pairings, "spread", Measure::completion)->configurations, 1U);
}

TEST(Statistics, WhatIsLaterThanTheLimitIsHeldAgainstIt) {
  EXPECT_EQ(fit_of({never}, {50}).median_ratio, 0.5);  // the limit is 100: at most this
  EXPECT_FALSE(fit_of({never}, {50}).mean_absolute_percent);
  EXPECT_EQ(fit_of({80, 80, never}, {never}).median_ratio, 1.25);  // at least this
}

TEST(Statistics, RangeAndCalibration) {
  const Fit f = fit_of({5, 15, 25, 100}, {10, 20, 30});
  EXPECT_EQ(f.in_range, 0.5);
  EXPECT_EQ(f.calibration[0], 0.25);  // quantile 0.1 is 12
  EXPECT_EQ(f.calibration[4], 0.5);   // the median is 20
  EXPECT_EQ(f.calibration[8], 0.75);  // quantile 0.9 is 28
}

TEST(Statistics, ACutOffRunIsNeitherCoveredNorDropped) {
  const Fit f = fit_of({10, 20, never}, {150});  // the limit of the cut-off run is 100
  EXPECT_EQ(f.runs, 3U);
  EXPECT_EQ(f.incomplete_runs, 1U);
  EXPECT_EQ(f.undecided_runs, 1U);
  EXPECT_DOUBLE_EQ(f.coverage, 2.0 / 3);
  EXPECT_EQ(f.median_ratio, 7.5);  // the median of 10, 20 and never is 20
  EXPECT_EQ(fit_of({10, never}, {90}).undecided_runs, 0U);
}

TEST(Statistics, AModelRunWithoutEndIsAboveAllOthers) {
  const Fit f = fit_of({10, 20}, {30, never, never});
  EXPECT_EQ(f.incomplete_model_runs, 2U);
  EXPECT_EQ(f.coverage, 1);
  EXPECT_FALSE(f.median_ratio);  // infinite
  EXPECT_FALSE(f.mean_absolute_percent);
  const Fit both = fit_of({never}, {never});
  EXPECT_EQ(both.undecided_configurations, 1U);
  EXPECT_FALSE(both.median_ratio);
}

TEST(Statistics, NothingPredictedAndNothingSeenIsEqual) {
  EXPECT_EQ(fit_of({0, 0}, {0}).median_ratio, 1);
  EXPECT_FALSE(fit_of({0, 0}, {5}).median_ratio);  // infinite
}

}  // namespace statistics_test
}  // namespace stormproof::prediction
