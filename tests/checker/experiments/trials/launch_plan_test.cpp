// Who starts when under each plan, and which plan a deployment follows.
#include "checker/experiments/trials/launch_plan.hpp"

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

std::vector<std::int64_t> followed(const Plan& plan, const Deployment& base,
                                   const std::vector<std::int64_t>& drawn_ms, bool is_drawn) {
  model::Scenario drawn;
  drawn.deployment = started_at(drawn_ms);
  if (is_drawn) drawn.deployment.schedule = model::Schedule{};
  follow(plan, base, drawn);
  EXPECT_FALSE(drawn.deployment.schedule);
  std::vector<std::int64_t> starts;
  for (const auto& one : drawn.deployment.participants) {
    starts.push_back(one.start.count() / 1'000'000);
  }
  return starts;
}

/// What a seed adds stays, whatever the plan.
TEST(Plan, IsFollowedFromWhatTheSeedAdds) {
  const Deployment spread = started_at({0, 20, 40, 60});
  using Ms = std::vector<std::int64_t>;
  EXPECT_EQ(followed({Order::at_once}, spread, {1, 22, 43, 64}, false), (Ms{1, 2, 3, 4}));
  EXPECT_EQ(followed({Order::by_host, ms(50)}, spread, {1, 22, 43, 64}, false), (Ms{1, 2, 53, 54}));
  EXPECT_EQ(followed({Order::by_process, ms(10)}, spread, {1, 2, 3, 4}, true), (Ms{1, 12, 23, 34}));
  EXPECT_EQ(followed({Order::deployed}, spread, {1, 2, 3, 4}, true), (Ms{1, 2, 3, 4}));
}

TEST(Plan, MovesByAStep) {
  const Plan by_host{Order::by_host, ms(50)};
  EXPECT_EQ(stepped(by_host, 1.2), (Plan{Order::by_host, ms(60)}));
  EXPECT_EQ(stepped(by_host, 0.8), (Plan{Order::by_host, ms(40)}));
  EXPECT_FALSE(stepped({Order::at_once}, 1.2));
  EXPECT_FALSE(stepped({Order::deployed}, 0.8));
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
