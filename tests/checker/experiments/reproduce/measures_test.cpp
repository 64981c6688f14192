// The statistics of the evaluation, on made-up results whose values are known.
#include "checker/experiments/reproduce/measures.hpp"

#include <gtest/gtest.h>

#include "tests/checker/experiments/reproduce/examples.hpp"

namespace stormproof::reproduce {
namespace measures_test {

using model::HeartbeatPolicy;

class MeasuresTest : public ::testing::Test {
 protected:
  MeasuresTest()
      : published_{figures_with_grid("[1, 5]", "[2, 20, 30]")},
        results_{made_up(plan_of(published_, {{"paper"}, 15}))},
        measures_{results_} {}

  Published published_;
  Results results_;
  Measures measures_;
};

TEST_F(MeasuresTest, MeansAreOverTheEndpointsOfOneParticipantCount) {
  const auto periodic = measures_.mean_completion_s(0, HeartbeatPolicy::periodic, 5);
  EXPECT_NEAR(periodic.value(), 5 * (2 + 20 + 30) * 1e-3 / 3, 1e-12);
  const auto adaptive = measures_.mean_completion_s(0, HeartbeatPolicy::adaptive, 5);
  EXPECT_NEAR(adaptive.value(), periodic.value() / 2, 1e-12);
  EXPECT_EQ(measures_.mean_messages(0, HeartbeatPolicy::periodic, 1), 10);
  EXPECT_FALSE(measures_.mean_messages(0, HeartbeatPolicy::periodic, 2).has_value());
}

TEST_F(MeasuresTest, ASingleMissingCaseLeavesNoMean) {
  results_.outcomes.erase({0, Network::wireless, HeartbeatPolicy::periodic, orders[0], {5, 30}});
  EXPECT_FALSE(measures_.mean_completion_s(0, HeartbeatPolicy::periodic, 5).has_value());
  EXPECT_TRUE(measures_.mean_completion_s(0, HeartbeatPolicy::periodic, 1).has_value());
  EXPECT_FALSE(measures_.largest_wireless_to_wired(0).has_value());
  EXPECT_FALSE(measures_.completion_spreads(0).has_value());
}

TEST_F(MeasuresTest, RatiosDivideTotals) {
  EXPECT_EQ(measures_.wireless_to_wired(0, {5, 20}), 2);
  EXPECT_EQ(measures_.largest_wireless_to_wired(0), 2);
}

TEST_F(MeasuresTest, TheOpenLoopFractionIsOfHighLoadOnly) {
  // N_P ≥ 4 and N_E ≥ 20: two configurations, so the median is their mean.
  const double a = measures_.open_loop_s(0, {5, 20}) / (5 * 20 * 1e-3);
  const double b = measures_.open_loop_s(0, {5, 30}) / (5 * 30 * 1e-3);
  EXPECT_NEAR(measures_.open_loop_s(0, {5, 20}), 0.534847700, 1e-12);
  EXPECT_NEAR(measures_.open_loop_fraction(0)->median, (a + b) / 2, 1e-12);
}

TEST_F(MeasuresTest, SpreadsAreOverTheThreeOrders) {
  EXPECT_NEAR(measures_.completion_spread(0, {1, 2}).value(), 0.03, 1e-6);
  EXPECT_NEAR(measures_.largest_completion_spread(0).value(), 0.03, 1e-6);
  EXPECT_EQ(measures_.message_spread(0, Class::repair_data, {1, 2}), 0);
  const Case third{0, Network::wireless, HeartbeatPolicy::periodic, orders[2], {5, 2}};
  results_.outcomes[third].runs[0].counts.repair_data = 8;
  EXPECT_EQ(measures_.message_spread(0, Class::repair_data, {5, 2}), 3.0 / 8);
  EXPECT_EQ(measures_.largest_message_spread(0, Class::repair_data), 3.0 / 8);
}

TEST_F(MeasuresTest, MeanWithAnIncompleteRunDoesNotExist) {
  Outcome outcome;
  model::Counts counts;
  counts.heartbeat = 7;
  outcome.runs = {finished_run(2, counts), reproduce::Run{model::RunEnd::time_limit, {}, {}}};
  EXPECT_EQ(outcome.completed(), 1U);
  EXPECT_EQ(outcome.fastest_s(), 2);
  EXPECT_FALSE(outcome.slowest_s().has_value());
  EXPECT_FALSE(outcome.completion_s().has_value());
  EXPECT_FALSE(outcome.messages(Class::total).has_value());
  outcome.runs.pop_back();
  EXPECT_EQ(outcome.completion_s(), 2);
  EXPECT_EQ(outcome.messages(Class::total), 7);
  outcome.runs.clear();
  EXPECT_FALSE(outcome.completion_s().has_value());
}

TEST(Quartiles, AreInterpolated) {
  const Quartiles four = quartiles({4, 1, 3, 2});
  EXPECT_DOUBLE_EQ(four.q1, 1.75);
  EXPECT_DOUBLE_EQ(four.median, 2.5);
  EXPECT_DOUBLE_EQ(four.q3, 3.25);
  EXPECT_EQ(quartiles({7}).q1, 7);
}

TEST(Loopback, IsNormalisedByPairsAndByPopulation) {
  for (std::uint32_t hosts = 2; hosts <= 4; ++hosts) {
    for (std::uint32_t np = 1; np <= 6; ++np) {
      const LoopbackNormalisation normalise = loopback_normalisation(hosts, np);
      const double l = (hosts - 1.0) * np + 1;
      // What scales with directed pairs and with the square of the population comes out exactly.
      EXPECT_EQ(normalise.sedp(l * (l - 1)), hosts * (hosts - 1.0) * np * np);
      EXPECT_EQ(normalise.spdp(l * l), hosts * hosts * np * np * 1.0);
    }
  }
}

TEST_F(MeasuresTest, LoopbackErrorsAreRelativeToTheReference) {
  // HEARTBEATs: N_P in the made-up loopback runs; the reference has one for each of the 4·N_P²
  // relations.
  const double one = 1 * 2.0 / 2;
  const double five = 5 * 10.0 / 6;
  const double expected = ((4 - one) / 4 + (100 - five) / 100) / 2;
  EXPECT_NEAR(measures_.loopback_error(0, Class::heartbeat).value(), expected, 1e-12);
  EXPECT_EQ(measures_.loopback_configurations_with_repair(0), 6);
}

}  // namespace measures_test
}  // namespace stormproof::reproduce
