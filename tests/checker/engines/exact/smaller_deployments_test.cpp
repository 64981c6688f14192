// Where short counterexamples are looked for.
#include "checker/engines/exact/smaller_deployments.hpp"

#include <gtest/gtest.h>

#include "tests/props/monitored_run.hpp"

namespace stormproof::exact {
namespace smaller_deployments_test {

TEST(SmallerDeployments, BeginWithTheSmallest) {
  const model::Scenario scenario = props::shipped("wifi-5x20");
  const auto list = smaller_scenarios(scenario);
  ASSERT_FALSE(list.empty());
  EXPECT_EQ(list.front().deployment, model::Deployment::homogeneous(2, 1, 0));
  for (const model::Scenario& smaller : list) {
    EXPECT_LT(smaller.deployment.size(), scenario.deployment.size());
    EXPECT_TRUE(smaller.deployment.has_cross_host_pair());
    EXPECT_EQ(smaller.dds, scenario.dds);
    EXPECT_EQ(smaller.wireless, scenario.wireless);
  }
}

TEST(SmallerDeployments, StartAtTheLowerBoundsOfTheSchedule) {
  const model::Scenario scenario = props::shipped("wifi-5x20-fastdds");
  const model::Participant first =
      smaller_scenarios(scenario).front().deployment.participants.front();
  EXPECT_EQ(first.start, scenario.deployment.schedule->start_min);
  EXPECT_EQ(first.endpoints_done, scenario.deployment.schedule->endpoints_done_min);
}

TEST(SmallerDeployments, ContainPartsOfTheGivenOne) {
  const model::Scenario scenario = props::shipped("staggered-joins");
  bool late_joiner = false;
  for (const model::Scenario& smaller : smaller_scenarios(scenario)) {
    for (const model::Participant& participant : smaller.deployment.participants) {
      late_joiner = late_joiner || participant.start == model::Nanoseconds{2'000'000'000};
    }
  }
  EXPECT_TRUE(late_joiner);
}

}  // namespace smaller_deployments_test
}  // namespace stormproof::exact
