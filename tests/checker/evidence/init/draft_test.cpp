// Drafts of every distribution and RMW are scenarios that say what was asked for.
#include "checker/evidence/init/draft.hpp"

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

/// Numbers that make no scenario are refused in words about the numbers, not about a draft that
/// nobody has seen.
TEST(Draft, RefusesNumbersThatNobodyCanRun) {
  System system;
  system.hosts = 1;
  const auto alone = draft(system, specs());
  ASSERT_FALSE(alone);
  EXPECT_TRUE(to_string(alone.error()).starts_with("--hosts 1: on a single host nothing crosses"));
  system.hosts = 2;
  system.participants = 200;
  const auto crowded = draft(system, specs());
  ASSERT_FALSE(crowded);
  EXPECT_TRUE(to_string(crowded.error())
                  .starts_with("--participants 200: expected at most 101 participants on a host"))
      << to_string(crowded.error());
}

/// Who is at no port that is asked is not found by others of his kind.
TEST(Draft, SaysWhoIsAtNoPort) {
  System system;
  system.discovery = "static";
  system.participants = 6;
  const auto text = draft(system, specs());
  ASSERT_TRUE(text) << to_string(text.error());
  EXPECT_NE(text->find("# Announcements go to 4 ports of each host"), std::string::npos) << *text;
  system.participants = 4;
  EXPECT_EQ(draft(system, specs())->find("# Announcements go to"), std::string::npos);
}

TEST(Draft, OfACaptureHasItsParticipants) {
  const auto conversation = conform::testing::shipped("fastdds291_ap_np3_ne10_r0");
  const auto text = draft_of_capture(conversation, {});
  ASSERT_TRUE(text) << to_string(text.error());
  const model::Scenario drafted = scenario_of(*text);
  EXPECT_EQ(drafted.deployment.participants.size(), 6U);
  EXPECT_NE(text->find("dds: 'fastdds-2.9.1'"), std::string::npos) << *text;
}

/// Fast DDS 3 asks for types; earlier versions and Cyclone DDS do not.
TEST(Draft, SaysHowManyTypesOthersDoNotHave) {
  const auto types = [](const System& system) {
    const auto text = draft(system, specs());
    EXPECT_TRUE(text) << to_string(text.error());
    return scenario_of(*text).deployment.types;
  };
  System system;
  EXPECT_FALSE(looks_up_types(system, specs()));
  EXPECT_FALSE(types(system).has_value());
  system.ros = "lyrical";
  system.knows_ros = true;
  ASSERT_TRUE(looks_up_types(system, specs()));
  EXPECT_EQ(types(system), model::EndpointTypes{usual_unknown_types});
  system.unknown_types = 3;
  EXPECT_EQ(types(system), model::EndpointTypes{3});
  system.unknown_types = 0;
  EXPECT_EQ(types(system), model::EndpointTypes{0});
  system.unknown_types.reset();
  system.endpoints = 1;
  system.unknown_types = 13;
  EXPECT_EQ(types(system), model::EndpointTypes{13}) << "12 of services and its own";
  system.unknown_types = 14;
  EXPECT_FALSE(draft(system, specs()));
  system.unknown_types.reset();
  system.discovery = "server";
  EXPECT_FALSE(types(system).has_value());
  system.discovery.clear();
  system.rmw = "cyclonedds";
  EXPECT_FALSE(looks_up_types(system, specs()));
}

TEST(Draft, OfACaptureHasTheTypesThatItShows) {
  const auto unknown =
      conform::testing::shipped("fastdds-3/fastdds362_ap150_simple_xtypes_unknown_np1_ne2_r1");
  const auto text = draft_of_capture(unknown, {});
  ASSERT_TRUE(text) << to_string(text.error());
  EXPECT_EQ(scenario_of(*text).deployment.types, model::EndpointTypes{12}) << *text;
  const auto known =
      conform::testing::shipped("fastdds-3/fastdds362_ap150_simple_xtypes_np3_ne20_r2");
  const auto other = draft_of_capture(known, {});
  ASSERT_TRUE(other) << to_string(other.error());
  EXPECT_EQ(scenario_of(*other).deployment.types, model::EndpointTypes{0}) << *other;
  const auto none = conform::testing::shipped("fastdds-3/fastdds362_ap150_simple_np1_ne2_r0");
  const auto plain = draft_of_capture(none, {});
  ASSERT_TRUE(plain) << to_string(plain.error());
  EXPECT_FALSE(scenario_of(*plain).deployment.types.has_value()) << *plain;
}

}  // namespace draft_test
}  // namespace stormproof::init
