// Which properties speak of Cyclone DDS: what certificates from its rules prove, what monitors that
// know it observe, and no more.
#include "props/applicability.hpp"

#include <algorithm>
#include <string_view>
#include <vector>

#include <gtest/gtest.h>

#include "props/monitor.hpp"

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
  }
  EXPECT_TRUE(is_watched(cyclone(), "safety.ack-implies-received"));
  EXPECT_FALSE(is_watched(cyclone(), "safety.snapshot"));
}

TEST(CycloneDds, IsSpokenOfByWhatItsMonitorsObserve) {
  for (const char* const property : {"composition.followed", "safety.repair-only-if-asked",
                                     "live.no-stall", "storm.feedback-gain"}) {
    EXPECT_EQ(why_not_applicable(property, cyclone()), "") << property;
    EXPECT_TRUE(is_watched(cyclone(), property)) << property;
  }
}

TEST(CycloneDds, IsNotSpokenOfByPropertiesOfOtherWriters) {
  for (const char* const property :
       {"timer.single-heartbeat", "timer.suppression-honoured", "live.completion",
        "live.quiescence", "storm.single-copy", "composition.pending"}) {
    EXPECT_NE(why_not_applicable(property, cyclone()), "") << property;
    EXPECT_EQ(why_not_applicable(property, model::Scenario{}), "") << property;
  }
}

}  // namespace applicability_test
}  // namespace stormproof::props
