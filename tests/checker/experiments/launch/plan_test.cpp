// Who starts when under each plan, and which plan a deployment follows.
#include "checker/experiments/launch/plan.hpp"

#include <gtest/gtest.h>

namespace stormproof::launch {
namespace plan_test {

using model::Deployment;
using model::Nanoseconds;

constexpr Nanoseconds ms(std::int64_t value) { return Nanoseconds{value * 1'000'000}; }

Deployment started_at(const std::vector<std::int64_t>& starts_ms) {
  Deployment deployment = Deployment::homogeneous(2, 2, 4);
  for (std::size_t i = 0; i < starts_ms.size(); ++i) {
    deployment.participants[i].start = ms(starts_ms[i]);
  }
  return deployment;
}

using Starts = std::vector<std::uint32_t>;

TEST(Plan, SaysWhoStartsWithWhom) {
  const Deployment deployment = Deployment::homogeneous(2, 2, 4);
  EXPECT_EQ(starts_of(deployment, Order::at_once), (Starts{0, 0, 0, 0}));
  EXPECT_EQ(starts_of(deployment, Order::by_process), (Starts{0, 1, 2, 3}));
  EXPECT_EQ(starts_of(deployment, Order::by_host), (Starts{0, 0, 1, 1}));
  EXPECT_EQ(starts_of(deployment, Order::waves), (Starts{0, 0, 1, 1}));
  EXPECT_EQ(starts_of(deployment, Order::late_tool), (Starts{0, 0, 0, 1}));
}

TEST(Plan, IsRecognisedInADeployment) {
  EXPECT_EQ(plan_of(started_at({7, 7, 7, 7})), (Plan{Order::at_once}));
  EXPECT_EQ(plan_of(started_at({5, 25, 45, 65})), (Plan{Order::by_process, ms(20)}));
  EXPECT_EQ(plan_of(started_at({0, 0, 300, 300})), (Plan{Order::by_host, ms(300)}));
  EXPECT_EQ(plan_of(started_at({0, 20, 40, 70})), (Plan{Order::deployed}));
  Deployment drawn = started_at({0, 20, 40, 60});
  drawn.schedule = model::Schedule{};
  EXPECT_EQ(plan_of(drawn), (Plan{Order::at_once}));
}

TEST(Plan, TheDeployedOneIsTheFirstOfThoseToCompare) {
  const auto plans = plans_for(started_at({0, 20, 40, 60}), {ms(20), ms(100)}, ms(400));
  EXPECT_EQ(plans, (std::vector<Plan>{{Order::by_process, ms(20)},
                                      {Order::at_once},
                                      {Order::by_process, ms(100)},
                                      {Order::by_host, ms(20)},
                                      {Order::by_host, ms(100)},
                                      {Order::waves},
                                      {Order::late_tool}}));
  EXPECT_EQ(plans_for(started_at({}), {ms(100)}, ms(300)).size(), 4U);  // by process: too long
}

TEST(Plan, OfHostsWithOneProcessEachIsNotSaidTwice) {
  for (const Plan& plan : plans_for(Deployment::homogeneous(3, 1, 4), usual_steps(), ms(60'000))) {
    EXPECT_NE(plan.order, Order::by_host);
  }
}

}  // namespace plan_test
}  // namespace stormproof::launch
