// Start times of a seed: the same for the same seed, within the jitter, drawn from the schedule.
#include "checker/experiments/trials/under_seed.hpp"

#include <algorithm>

#include <gtest/gtest.h>

#include "checker/experiments/trials/losses.hpp"
#include "model/deployment.hpp"

namespace stormproof::trials {
namespace under_seed_test {

using model::Nanoseconds;

model::Scenario scenario() {
  model::Scenario scenario;
  scenario.deployment = model::Deployment::homogeneous(2, 3, 2);
  return scenario;
}

std::vector<std::int64_t> starts(const model::Scenario& scenario) {
  std::vector<std::int64_t> times;
  for (const model::Participant& one : scenario.deployment.participants) {
    times.push_back(one.start.count());
  }
  return times;
}

TEST(UnderSeed, WithoutScheduleAndJitterNothingChanges) {
  EXPECT_EQ(starts(under_seed(scenario(), 5)), starts(scenario()));
}

TEST(UnderSeed, JitterDependsOnTheSeedAlone) {
  constexpr Nanoseconds jitter{1'000};
  const auto first = starts(under_seed(scenario(), 1, jitter));
  EXPECT_EQ(first, starts(under_seed(scenario(), 1, jitter)));
  EXPECT_NE(first, starts(under_seed(scenario(), 2, jitter)));
  const auto unchanged = starts(scenario());
  for (std::size_t k = 0; k < first.size(); ++k) {
    EXPECT_GE(first[k], unchanged[k]);
    EXPECT_LE(first[k], unchanged[k] + jitter.count());
  }
}

TEST(UnderSeed, EndpointsAreDoneLaterByTheSame) {
  const model::Scenario drawn = under_seed(scenario(), 3, Nanoseconds{500});
  const model::Scenario before = scenario();
  for (std::size_t k = 0; k < before.deployment.participants.size(); ++k) {
    const auto& then = before.deployment.participants[k];
    const auto& now = drawn.deployment.participants[k];
    EXPECT_EQ((now.start - then.start).count(), (now.endpoints_done - then.endpoints_done).count());
  }
}

TEST(UnderSeed, DrawsTheSchedule) {
  model::Scenario sampled = scenario();
  sampled.deployment.schedule.emplace();
  model::Scenario expected = sampled;
  expected.deployment.draw_schedule(9);
  EXPECT_EQ(starts(under_seed(sampled, 9)), starts(expected));
}

TEST(DrawLosses, HasTheRateAndDependsOnTheSeed) {
  const auto lost = draw_losses(0.05, 3);
  EXPECT_NEAR(static_cast<double>(lost.size()), 100'000, 2'000);
  EXPECT_TRUE(std::ranges::is_sorted(lost));
  EXPECT_NE(lost, draw_losses(0.05, 4));
  EXPECT_TRUE(draw_losses(0, 3).empty());
}

}  // namespace under_seed_test
}  // namespace stormproof::trials
