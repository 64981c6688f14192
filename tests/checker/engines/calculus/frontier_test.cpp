// The largest load that is proved: it is proved, one more is not, and the scenario's own variants
// are what the short form makes.
#include "checker/engines/calculus/frontier.hpp"

#include <gtest/gtest.h>

#include "checker/engines/calculus/cannot_start.hpp"

namespace stormproof::calculus {
namespace frontier_test {

using model::Nanoseconds;

model::Scenario patient(std::uint32_t hosts, std::uint32_t participants, std::uint32_t endpoints) {
  model::Scenario scenario;
  scenario.deployment = model::Deployment::homogeneous(hosts, participants, endpoints);
  scenario.dds.sedp.heartbeat_response_delay = Nanoseconds{4'000'000'000};
  scenario.dds.sedp.initial_acknack_delay = Nanoseconds{4'000'000'000};
  return scenario;
}

TEST(Frontier, IsTheLastLoadThatIsProved) {
  const std::vector<Frontier> frontiers = frontier_of(patient(2, 5, 20)).of_loads;
  ASSERT_EQ(frontiers.size(), 3U);
  const std::uint32_t endpoints = *frontiers[0].most;
  const std::uint32_t participants = *frontiers[1].most;
  const std::uint32_t hosts = *frontiers[2].most;
  EXPECT_EQ(frontiers[0].now, 20U);
  EXPECT_EQ(frontiers[1].now, 5U);
  EXPECT_EQ(frontiers[2].now, 2U);
  EXPECT_TRUE(judge(patient(2, 5, endpoints)).is_proved());
  EXPECT_FALSE(judge(patient(2, 5, endpoints + 1)).is_proved());
  EXPECT_TRUE(judge(patient(2, participants, 20)).is_proved());
  EXPECT_FALSE(judge(patient(2, participants + 1, 20)).is_proved());
  EXPECT_TRUE(judge(patient(hosts, 5, 20)).is_proved());
  EXPECT_FALSE(judge(patient(hosts + 1, 5, 20)).is_proved());
  EXPECT_EQ(frontiers[0].delay, judge(patient(2, 5, endpoints)).delay);
}

/// The search relies on it.
TEST(Frontier, MoreLoadTakesLonger) {
  Nanoseconds before;
  for (const std::uint32_t endpoints : {0U, 1U, 2U, 3U, 7U, 20U, 21U, 60U}) {
    const Nanoseconds delay = *judge(patient(2, 3, endpoints)).delay;
    EXPECT_GE(delay, before) << endpoints;
    before = delay;
  }
  before = {};
  for (const std::uint32_t participants : {1U, 2U, 3U, 4U, 5U, 6U}) {
    const Nanoseconds delay = *judge(patient(2, participants, 9)).delay;
    EXPECT_GT(delay, before) << participants;
    before = delay;
  }
}

TEST(Frontier, OfWhatNoLoadAllows) {
  model::Scenario scenario = patient(2, 1, 2);
  scenario.dds.sedp.heartbeat_response_delay = Nanoseconds{10'000};
  const Frontiers none = frontier_of(scenario);
  ASSERT_EQ(none.of_loads.size(), 3U);
  for (const Frontier& one : none.of_loads) EXPECT_FALSE(one.most) << one.load;
}

TEST(Frontier, OfALinkHasNoEnd) {
  model::Scenario scenario = patient(2, 1, 2);
  scenario.wireless.kind = model::ServiceKind::constant_delay;
  scenario.wireless.one_way = Nanoseconds{1'000};
  scenario.deployment.participants[0].publications = 5;
  const std::vector<Frontier> frontiers = frontier_of(scenario).of_loads;
  EXPECT_FALSE(frontiers[0].now);
  for (const Frontier& one : frontiers) EXPECT_EQ(one.most, one.limit) << one.load;
}

}  // namespace frontier_test
}  // namespace stormproof::calculus
