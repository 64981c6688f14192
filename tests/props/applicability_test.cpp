// Which properties speak of Cyclone DDS: what certificates from its rules prove, what monitors that
// know it observe, and no more. And which of a Discovery Server: those that speak of Fast DDS's
// exchange do so of what clients tell it.
#include "props/applicability.hpp"

#include <algorithm>
#include <string_view>
#include <vector>

#include <gtest/gtest.h>

#include "model/implementations.hpp"
#include "props/monitor.hpp"
#include "props/property.hpp"

namespace stormproof::props {
namespace applicability_test {

model::Scenario cyclone() {
  model::Scenario scenario;
  scenario.dds.implementation = model::ImplementationKind::cyclone;
  return scenario;
}
bool is_watched(const model::Scenario& scenario, std::string_view property) {
  const std::vector<std::string_view> watched = monitored_properties(scenario);
  return std::ranges::find(watched, property) != watched.end();
}

TEST(CycloneDds, IsSpokenOfByWhatItsRulesProve) {
  for (const char* const property : {"safety.ack-implies-received", "safety.snapshot"}) {
    EXPECT_EQ(why_not_applicable(property, cyclone()), "") << property;
    EXPECT_EQ(why_not_provable(property, cyclone()), "") << property;
    EXPECT_TRUE(is_watched(model::Scenario{}, property)) << property;
    EXPECT_TRUE(is_watched(cyclone(), property)) << property;
  }
}

TEST(CycloneDds, IsSpokenOfByWhatItsMonitorsObserve) {
  for (const char* const property : {"composition.followed", "safety.repair-only-if-asked",
                                     "live.no-stall", "storm.feedback-gain"}) {
    EXPECT_EQ(why_not_applicable(property, cyclone()), "") << property;
    EXPECT_TRUE(is_watched(cyclone(), property)) << property;
  }
}

TEST(CycloneDds, IsSpokenOfByTheExplorerWhereNoCertificateIs) {
  const auto is_explored = [](const char* property, const model::Scenario& scenario) {
    return is_only_explored(property, model::kind_of(scenario.dds));
  };
  for (const char* const property : {"safety.repair-only-if-asked", "live.no-stall"}) {
    EXPECT_TRUE(is_explored(property, cyclone())) << property;
    EXPECT_FALSE(is_explored(property, model::Scenario{})) << property;
    EXPECT_EQ(why_not_provable(property, cyclone()), "") << property;
  }
  for (const char* const property : {"safety.ack-implies-received", "storm.feedback-gain"}) {
    EXPECT_FALSE(is_explored(property, cyclone())) << property;
  }
  EXPECT_NE(why_not_provable("storm.feedback-gain", cyclone()), "");
}

TEST(CycloneDds, IsNotSpokenOfByPropertiesOfOtherWriters) {
  for (const char* const property :
       {"timer.single-heartbeat", "timer.suppression-honoured", "live.completion",
        "live.quiescence", "storm.single-copy", "composition.pending"}) {
    EXPECT_NE(why_not_applicable(property, cyclone()), "") << property;
    EXPECT_EQ(why_not_applicable(property, model::Scenario{}), "") << property;
  }
}

TEST(Server, IsSpokenOfByWhatItsClientsTellIt) {
  for (const model::Discovery discovery :
       {model::Discovery::server, model::Discovery::super_client}) {
    model::Scenario scenario;
    scenario.dds.implementation = model::ImplementationKind::fastdds;
    scenario.dds.discovery = discovery;
    for (const char* const property : {"safety.ack-implies-received", "safety.repair-only-if-asked",
                                       "safety.snapshot", "timer.single-heartbeat"}) {
      EXPECT_EQ(why_not_applicable(property, scenario), "") << property;
      EXPECT_EQ(why_not_provable(property, scenario), "") << property;
      EXPECT_TRUE(is_watched(scenario, property)) << property;
    }
    for (const char* const property :
         {"safety.ack-stable", "timer.suppression-honoured", "storm.feedback-gain"}) {
      EXPECT_TRUE(is_watched(scenario, property)) << property;
      EXPECT_NE(why_not_provable(property, scenario), "") << property;
    }
    EXPECT_TRUE(is_watched(scenario, "composition.followed"));
    EXPECT_EQ(why_not_applicable("composition.live", scenario), "");
    EXPECT_FALSE(is_watched(scenario, "composition.live"));
    for (const char* const property :
         {"composition.pending", "order.commutation", "live.no-stall", "live.completion",
          "live.quiescence", "storm.single-copy", "storm.cannot-start"}) {
      EXPECT_NE(why_not_applicable(property, scenario), "") << property;
    }
    const model::ImplementationKind kind = model::kind_of(scenario.dds);
    EXPECT_TRUE(is_about_clients("safety.snapshot", kind));
    EXPECT_FALSE(is_about_clients("composition.followed", kind));
    EXPECT_NE(statement_of(*find_property("safety.snapshot"), kind).find("tell the server"),
              std::string::npos);
  }
}

}  // namespace applicability_test
}  // namespace stormproof::props
