// Nodes that share a participant: what a component container does to a deployment.
#include <gtest/gtest.h>

#include "model/config/scenario_file.hpp"
#include "model/nodes.hpp"
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

Result<Scenario> with_nodes(const std::string& nodes) {
  return read({"deployment={hosts: 2, nodes: " + nodes + "}"});
}

TEST(Nodes, AListOfNodesIsADeployment) {
  const auto alike = with_nodes("[{publications: 10, subscriptions: 10, count: 5}]");
  ASSERT_TRUE(alike) << to_string(alike.error());
  EXPECT_EQ(alike->deployment, read({})->deployment);
  const auto together =
      with_nodes("[{publications: 10, subscriptions: 10, count: 5}], nodes_per_participant: 2");
  ASSERT_TRUE(together) << to_string(together.error());
  EXPECT_EQ(together->deployment, read({"deployment.nodes_per_participant=2"})->deployment);
}

TEST(Nodes, ShareParticipantsInTheirOrder) {
  const auto scenario = with_nodes(
      "[{name: lidar, publications: 4, subscriptions: 2}, {publications: 1, subscriptions: 3}, "
      "{publications: 7, subscriptions: 0}], nodes_per_participant: 2");
  ASSERT_TRUE(scenario) << to_string(scenario.error());
  const auto& participants = scenario->deployment.participants;
  ASSERT_EQ(participants.size(), 4U);
  EXPECT_EQ(participants[0].publications, 4 + 1 + Deployment::publications_of_a_node);
  EXPECT_EQ(participants[0].subscriptions, 2 + 3 + Deployment::subscriptions_of_a_node);
  EXPECT_EQ(participants[1].publications, 7U);
  EXPECT_EQ(participants[1].host, HostId{0});
  EXPECT_EQ(participants[2].host, HostId{1});
}

TEST(Nodes, WhatIsWrongHasItsPlace) {
  const auto message = [](const std::string& nodes) {
    const auto read = with_nodes(nodes);
    return read ? std::string{} : to_string(read.error());
  };
  EXPECT_NE(message("[]").find("nodes: a list of 0"), std::string::npos) << message("[]");
  EXPECT_NE(message("[{publications: 1}]").find("subscriptions"), std::string::npos);
  EXPECT_NE(message("[{publications: 1, subscriptions: 1, topics: 2}]").find("topics"),
            std::string::npos);
  EXPECT_NE(message("[{publications: 1, subscriptions: 1, count: 3000}]").find("at most 4000"),
            std::string::npos);
  const std::string one = "[{publications: 1, subscriptions: 1}]";
  EXPECT_NE(message(one + ", participants_per_host: 2").find("not together with nodes"),
            std::string::npos);
  EXPECT_NE(message(one + ", participants: [{host: 0, publications: 1, subscriptions: 1}]")
                .find("not together with participants"),
            std::string::npos);
  EXPECT_NE(message("[{publications: 60000, subscriptions: 1, count: 2}], nodes_per_participant: 2")
                .find("share participants"),
            std::string::npos);
}

TEST(NodesPerParticipant, IsRefusedWhereItCannotBe) {
  EXPECT_FALSE(read({"deployment.nodes_per_participant=0"}));
  const auto many =
      read({"deployment.nodes_per_participant=5", "deployment.endpoints_per_participant=30000"});
  ASSERT_FALSE(many);
  EXPECT_NE(to_string(many.error()).find("nodes_per_participant"), std::string::npos);
}

/// A node has 17 endpoints, each further one of the participant 15; and 24 B for each.
TEST(GraphInfo, GrowsWithWhatSharesAParticipant) {
  EXPECT_EQ(last_graph_info(Deployment::homogeneous(2, 5, 20)), Bytes{24 * 37});
  EXPECT_EQ(last_graph_info(Deployment::homogeneous(2, 5, 20, 5)), Bytes{24 * 177});
  EXPECT_EQ(last_graph_info(Deployment::homogeneous(2, 5, 20, 4)), Bytes{24 * 142});
}

}  // namespace nodes_per_participant_test
}  // namespace stormproof::model::config
