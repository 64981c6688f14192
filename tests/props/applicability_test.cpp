// Which properties speak of Cyclone DDS: what certificates from its rules prove, and no more.
#include "props/applicability.hpp"

#include <gtest/gtest.h>

#include "model/scenario.hpp"
#include "props/monitor.hpp"
#include "props/property.hpp"

namespace stormproof::props {
namespace applicability_test {

model::Scenario cyclone() {
  model::Scenario scenario;
  scenario.dds.implementation = model::ImplementationKind::cyclone;
  return scenario;
}

TEST(CycloneDds, IsCertifiedWhereNoMonitorWatchesIt) {
  const std::vector<std::string_view> watched = monitored_properties(cyclone());
  for (const char* const property : {"safety.ack-implies-received", "safety.snapshot"}) {
    EXPECT_EQ(why_not_applicable(property, cyclone()), "") << property;
    EXPECT_EQ(why_not_provable(property, cyclone()), "") << property;
    EXPECT_EQ(std::ranges::count(watched, property), 0) << property;
    EXPECT_EQ(std::ranges::count(monitored_properties(model::Scenario{}), property), 1);
  }
}

TEST(CycloneDds, IsNotSpokenOfByPropertiesOfOtherWriters) {
  for (const char* const property :
       {"safety.repair-only-if-asked", "timer.single-heartbeat", "live.no-stall", "live.completion",
        "storm.single-copy", "composition.followed", "composition.live"}) {
    EXPECT_NE(why_not_applicable(property, cyclone()), "") << property;
    EXPECT_EQ(why_not_applicable(property, model::Scenario{}), "") << property;
  }
}

}  // namespace applicability_test
}  // namespace stormproof::props
