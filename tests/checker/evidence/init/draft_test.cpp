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
