// Nodes that share a participant: what a component container does to a deployment.
#include <gtest/gtest.h>

#include "model/config/scenario_file.hpp"
#include "model/reference.hpp"

namespace stormproof::model::config {
namespace nodes_per_participant_test {

Result<Scenario> read(std::vector<std::string> overrides) {
  return read_scenario("wifi-5x20", overrides, {{STORMPROOF_SPECS_DIR}});
}

TEST(NodesPerParticipant, OneContainerOnEachRobotHasTheEndpointsOfAll) {
  const auto apart = read({});
  const auto together = read({"deployment.nodes_per_participant=5"});
  ASSERT_TRUE(apart && together) << to_string(together.error());
  ASSERT_EQ(together->deployment.size(), 2U);
  EXPECT_EQ(together->deployment.participants[0].publications, 5 * 10U + 4 * 8U);
  EXPECT_EQ(together->deployment.participants[0].subscriptions, 5 * 10U + 4 * 7U);
  EXPECT_EQ(failure_free_reference(*apart).initial_data, 1'850U);
  EXPECT_EQ(failure_free_reference(*together).initial_data, 354U);
  EXPECT_EQ(failure_free_reference(*together).acknack, 4U);
}

TEST(NodesPerParticipant, TheLastParticipantOfAHostHasTheRest) {
  const auto scenario = read({"deployment.nodes_per_participant=2"});
  ASSERT_TRUE(scenario);
  ASSERT_EQ(scenario->deployment.size(), 6U);
  const auto& participants = scenario->deployment.participants;
  EXPECT_EQ(participants[0].publications, 2 * 10U + 8U);
  EXPECT_EQ(participants[2].publications, 10U);
  EXPECT_EQ(participants[2].host, HostId{0});
  EXPECT_EQ(participants[3].host, HostId{1});
  EXPECT_EQ(read({"deployment.nodes_per_participant=1"})->deployment, read({})->deployment);
  EXPECT_EQ(read({"deployment.nodes_per_participant=99"})->deployment.size(), 2U);
}

TEST(NodesPerParticipant, IsRefusedWhereItCannotBe) {
  EXPECT_FALSE(read({"deployment.nodes_per_participant=0"}));
  const auto many =
      read({"deployment.nodes_per_participant=5", "deployment.endpoints_per_participant=30000"});
  ASSERT_FALSE(many);
  EXPECT_NE(to_string(many.error()).find("nodes_per_participant"), std::string::npos);
}

}  // namespace nodes_per_participant_test
}  // namespace stormproof::model::config
