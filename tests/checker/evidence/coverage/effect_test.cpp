// Ratios to a baseline, their intervals, and what a measurement says of a prediction.
#include "checker/evidence/coverage/effect.hpp"

#include <gtest/gtest.h>

#include "examples.hpp"

namespace stormproof::prediction {
namespace effect_test {

/// The effect when one configuration is predicted and measured, changed and unchanged.
Effect effect_of(const std::vector<double>& changed_model,
                 const std::vector<double>& changed_runs) {
  const std::vector<double> unchanged{98, 99, 100, 101, 102};
  const Configuration changed = configuration_of(changed_runs);
  const Configuration baseline = configuration_of(unchanged);
  const Prediction changed_prediction = prediction_of(changed_model);
  const Prediction baseline_prediction = prediction_of(unchanged);
  const auto pairs =
      contrasts({{&changed, &changed_prediction}}, {{&baseline, &baseline_prediction}});
  return *effect(pairs, "all", Measure::completion, true);
}

TEST(Effect, IsTheRatioOfMediansWithAnIntervalAroundIt) {
  const Effect e = effect_of({40, 50, 60}, {45, 50, 55});
  EXPECT_EQ(e.predicted.median, 0.5);
  EXPECT_LT(e.predicted.low, 0.5);
  EXPECT_GT(e.predicted.high, 0.5);
  EXPECT_EQ(e.observed->median, 0.5);
}

TEST(Effect, MeasurementsConfirmOrRefute) {
  EXPECT_EQ(effect_of({40, 50, 60}, {45, 50, 55}).verdict, EffectVerdict::confirmed);
  EXPECT_EQ(effect_of({9, 10, 11}, {45, 50, 55}).verdict, EffectVerdict::direction_only);
  EXPECT_EQ(effect_of({40, 50, 60}, {190, 200, 210}).verdict, EffectVerdict::refuted);
  EXPECT_EQ(effect_of({40, 50, 60}, {90, 100, 110}).verdict, EffectVerdict::refuted);
}

TEST(Effect, AMeasurementThatAllowsBothLeavesItOpen) {
  EXPECT_EQ(effect_of({80, 85, 90}, {60, 90, 150}).verdict, EffectVerdict::open);
}

TEST(Effect, OnlyEqualDeploymentsAreCompared) {
  const Configuration one = configuration_of({10}, 1);
  const Configuration two = configuration_of({10}, 2);
  const Prediction prediction = prediction_of({10});
  EXPECT_TRUE(contrasts({{&one, &prediction}}, {{&two, &prediction}}).empty());
  EXPECT_FALSE(effect({}, "all", Measure::completion, true));
}

TEST(Effect, ASystemThatDoesNotCompleteIsWorse) {
  EXPECT_EQ(effect_of({never, never, never}, {never}).predicted.median, never);
}

}  // namespace effect_test
}  // namespace stormproof::prediction
