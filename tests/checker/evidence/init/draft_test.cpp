// Drafts of every distribution and RMW are scenarios that say what was asked for.
#include "checker/evidence/init/draft.hpp"

#include <map>

#include <gtest/gtest.h>

#include "model/config/distributions.hpp"
#include "model/config/scenario_file.hpp"
#include "model/config/tree/quantities.hpp"
#include "tests/checker/evidence/conform/captures.hpp"

namespace stormproof::init {
namespace draft_test {

model::config::SpecPath specs() { return {{STORMPROOF_SPECS_DIR}}; }

model::Scenario scenario_of(const std::string& text) {
  const auto read = model::config::parse_scenario(text, "draft", {}, specs());
  EXPECT_TRUE(read) << to_string(read.error()) << "\n" << text;
  return *read;
}

TEST(Draft, IsAScenarioForEveryDistribution) {
  for (const auto rmw : {model::config::Rmw::of_the_distribution, model::config::Rmw::cyclonedds}) {
    const auto known = model::config::read_distributions(specs().directories, rmw);
    ASSERT_TRUE(known) << to_string(known.error());
    ASSERT_FALSE(known->empty());
    for (const model::config::Distribution& one : *known) {
      System system;
      system.ros = one.name;
      if (rmw == model::config::Rmw::cyclonedds) system.rmw = "cyclonedds";
      system.hosts = 3;
      system.participants = 2;
      system.endpoints = 7;
      const auto text = draft(system, specs());
      ASSERT_TRUE(text) << to_string(text.error());
      const model::Scenario drafted = scenario_of(*text);
      EXPECT_EQ(drafted.deployment.host_count(), 3U);
      EXPECT_EQ(drafted.deployment.participants.size(), 6U);
      EXPECT_TRUE(drafted.deployment.schedule) << "start times are ranges";
      EXPECT_NE(text->find("dds: '" + one.profile + "'"), std::string::npos) << *text;
    }
  }
}

TEST(Draft, RefusesWhatNobodyKnows) {
  System system;
  system.ros = "humbel";
  const auto distribution = draft(system, specs());
  ASSERT_FALSE(distribution);
  EXPECT_NE(to_string(distribution.error()).find("humble"), std::string::npos);
  system.ros = "humble";
  system.rmw = "zenoh";
  EXPECT_FALSE(draft(system, specs()));
  system.rmw = "fastrtps";
  system.dds = "nosuch";
  EXPECT_FALSE(draft(system, specs()));
}

TEST(Draft, TakesWhatTheEnvironmentSays) {
  std::map<std::string, std::string> environment{{"ROS_DISTRO", "jazzy"},
                                                 {"RMW_IMPLEMENTATION", "rmw_cyclonedds_cpp"},
                                                 {"CYCLONEDDS_URI", "file:///etc/cyclone.xml"},
                                                 {"ROS_STATIC_PEERS", "10.0.0.2"}};
  const auto value_of = [&](const char* name) -> const char* {
    const auto found = environment.find(name);
    return found == environment.end() ? nullptr : found->second.c_str();
  };
  const auto system = from_environment({}, value_of);
  ASSERT_TRUE(system) << to_string(system.error());
  EXPECT_EQ(system->ros, "jazzy");
  EXPECT_EQ(system->rmw, "cyclonedds");
  EXPECT_EQ(system->dds, "/etc/cyclone.xml");
  ASSERT_EQ(system->remarks.size(), 2U);
  EXPECT_NE(system->remarks[1].find("ROS_STATIC_PEERS=10.0.0.2"), std::string::npos);
  environment = {{"ROS_DISTRO", "humble"}, {"ROS_DISCOVERY_SERVER", "10.0.0.1:11811"}};
  const auto client = from_environment({}, value_of);
  ASSERT_TRUE(client);
  const auto text = draft(*client, specs());
  ASSERT_TRUE(text) << to_string(text.error());
  EXPECT_NE(text->find("dds: 'fastdds-server-2.6.11'"), std::string::npos) << *text;
  environment["ROS_SUPER_CLIENT"] = "TRUE";
  const auto super = draft(*from_environment({}, value_of), specs());
  ASSERT_TRUE(super) << to_string(super.error());
  EXPECT_EQ(scenario_of(*super).dds.discovery, model::Discovery::super_client) << *super;
  environment["RMW_IMPLEMENTATION"] = "rmw_connextdds";
  EXPECT_FALSE(from_environment({}, value_of));
}

TEST(Draft, PeersTakeThePlaceOfMulticastOnlyWhereTheRangeSaysSo) {
  std::map<std::string, std::string> environment{{"ROS_DISTRO", "jazzy"},
                                                 {"ROS_STATIC_PEERS", "10.0.0.2;10.0.0.3"}};
  const auto drafted = [&] {
    const auto system = from_environment({}, [&](const char* name) -> const char* {
      const auto found = environment.find(name);
      return found == environment.end() ? nullptr : found->second.c_str();
    });
    const model::config::Result<std::string> text =
        system ? draft(*system, specs()) : model::config::Result<std::string>{system.error()};
    return text ? *text : to_string(text.error());
  };
  EXPECT_EQ(scenario_of(drafted()).dds.discovery, model::Discovery::simple) << drafted();
  EXPECT_NE(drafted().find("by multicast and to these"), std::string::npos) << drafted();
  environment["ROS_AUTOMATIC_DISCOVERY_RANGE"] = "SYSTEM_DEFAULT";
  EXPECT_EQ(scenario_of(drafted()).dds.discovery, model::Discovery::simple) << drafted();
  environment["ROS_AUTOMATIC_DISCOVERY_RANGE"] = "LOCALHOST";
  EXPECT_EQ(scenario_of(drafted()).dds.discovery, model::Discovery::static_peers) << drafted();
  EXPECT_EQ(scenario_of(drafted()).dds.peer_ports, 32U) << drafted();
  environment["ROS_AUTOMATIC_DISCOVERY_RANGE"] = "OFF";
  EXPECT_NE(drafted().find("nobody is discovered"), std::string::npos) << drafted();
}

TEST(Draft, OfACaptureHasItsParticipants) {
  const auto conversation = conform::testing::shipped("fastdds291_ap_np3_ne10_r0");
  const auto text = draft_of_capture(conversation, {});
  ASSERT_TRUE(text) << to_string(text.error());
  const model::Scenario drafted = scenario_of(*text);
  EXPECT_EQ(drafted.deployment.participants.size(), 6U);
  EXPECT_NE(text->find("dds: 'fastdds-2.9.1'"), std::string::npos) << *text;
}

}  // namespace draft_test
}  // namespace stormproof::init
