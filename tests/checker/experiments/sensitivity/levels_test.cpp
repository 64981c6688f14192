// What a step down and up makes of each kind of value.
#include "checker/experiments/sensitivity/levels.hpp"

#include <algorithm>

#include "tests/checker/experiments/sensitivity/scenarios.hpp"

namespace stormproof::sensitivity {
namespace levels_test {

Knob knob_of(const model::Scenario& scenario, const std::string& key, double range = 0.2) {
  const std::vector<Knob> knobs = knobs_of(scenario, range);
  const auto found = std::ranges::find(knobs, key, &Knob::key);
  if (found == knobs.end()) {
    ADD_FAILURE() << "no knob " << key;
    return {};
  }
  return *found;
}

/// "down → up", "–" for a level that does not exist.
std::string levels(const Knob& knob) {
  const auto text = [&](std::size_t d) { return knob.levels[d] ? knob.levels[d]->value : "–"; };
  return text(0) + " → " + text(1);
}

TEST(SensitivityLevels, DurationsRatesAndBytes) {
  const model::Scenario scenario = scenario_with({});
  EXPECT_EQ(levels(knob_of(scenario, "dds.sedp.heartbeat_period")), "800ms → 1.2s");
  EXPECT_EQ(levels(knob_of(scenario, "wireless.rate_multicast")), "4.8Mbps → 7.2Mbps");
  EXPECT_EQ(levels(knob_of(scenario, "wireless.mtu_payload_bytes", 0.5)), "740 → 2220");
  EXPECT_EQ(knob_of(scenario, "dds.sedp.heartbeat_period").value, "1s");
}

TEST(SensitivityLevels, ALevelChangesItsKnobAlone) {
  const model::Scenario scenario = scenario_with({});
  model::Scenario level = knob_of(scenario, "dds.sedp.heartbeat_period").levels[0]->scenario;
  EXPECT_EQ(level.dds.sedp.heartbeat_period, model::Nanoseconds{800'000'000});
  level.dds.sedp.heartbeat_period = scenario.dds.sedp.heartbeat_period;
  EXPECT_EQ(level, scenario);
}

TEST(SensitivityLevels, SmallNumbersMoveByOne) {
  const model::Scenario scenario = scenario_with({"dds.spdp.startup_announcements=1"});
  EXPECT_EQ(levels(knob_of(scenario, "dds.spdp.startup_announcements")), "0 → 2");
}

TEST(SensitivityLevels, ZeroHasNoStep) {
  const Knob knob =
      knob_of(scenario_with({"dds.sedp.nack_response_delay=0"}), "dds.sedp.nack_response_delay");
  EXPECT_EQ(levels(knob), "– → –");
  EXPECT_EQ(knob.obstacle, "0 has no relative range");
}

TEST(SensitivityLevels, LimitsAndRulesAreKept) {
  const Knob longest = knob_of(scenario_with({"dds.spdp.period=1000000s"}), "dds.spdp.period");
  EXPECT_EQ(levels(longest), "800000s → –");
  EXPECT_EQ(longest.obstacle, "no valid greater value");
  const Knob ordered =
      knob_of(scenario_with({"dds.sedp.adaptive.min_period=3s"}), "dds.sedp.adaptive.min_period");
  EXPECT_EQ(levels(ordered), "2.4s → –");
}

TEST(SensitivityLevels, OneParticipantMoreOrFewerOnEachHost) {
  const Knob smallest = knob_of(scenario_with({}), "deployment.participants");
  EXPECT_EQ(levels(smallest), "– → 4");
  const model::Scenario scenario = scenario_with({"deployment.participants_per_host=3"});
  const Knob knob = knob_of(scenario, "deployment.participants");
  EXPECT_EQ(levels(knob), "4 → 8");
  EXPECT_EQ(knob.levels[0]->scenario.deployment, model::Deployment::homogeneous(2, 2, 2));
  EXPECT_EQ(knob.levels[1]->scenario.deployment.host_count(), 2U);
}

TEST(SensitivityLevels, EndpointsOfAllParticipants) {
  const model::Scenario scenario = scenario_with({"deployment.endpoints_per_participant=20"});
  EXPECT_EQ(levels(knob_of(scenario, "deployment.endpoints")), "32 → 48");
}

TEST(SensitivityLevels, AScheduleMovesAsAWholeAndStaysDrawn) {
  const model::Scenario scenario = scenario_with(
      {"deployment.schedule={start: [0ms, 10ms], endpoints_done: [20ms, 50ms], seed: 3}"});
  const Knob knob = knob_of(scenario, "deployment.schedule");
  EXPECT_EQ(levels(knob), "to 40ms → to 60ms");
  model::Deployment redrawn = knob.levels[1]->scenario.deployment;
  redrawn.draw_schedule(3);
  EXPECT_EQ(redrawn, knob.levels[1]->scenario.deployment);
}

TEST(SensitivityLevels, KeysOfTheOtherImplementationAreNotThere) {
  const auto keys = knobs_of(scenario_with({"dds=fastdds-2.6.11"}), 0.2);
  const auto has = [&](const char* key) {
    return std::ranges::find(keys, key, &Knob::key) != keys.end();
  };
  EXPECT_TRUE(has("deployment.loopback_delay"));
  EXPECT_TRUE(has("dds.sedp.grouping_limit_bytes"));
  EXPECT_FALSE(has("dds.sedp.heartbeat_bytes"));
}

TEST(SensitivityLevels, MovedGoesOnTopOfOtherChanges) {
  const model::Scenario scenario = scenario_with({});
  const auto one = moved(scenario, "deployment.participants", Direction::up, 0.2);
  ASSERT_TRUE(one);
  const auto both = moved(one->scenario, "dds.sedp.heartbeat_period", Direction::down, 0.2);
  ASSERT_TRUE(both);
  EXPECT_EQ(both->value, "800ms");
  EXPECT_EQ(both->scenario.deployment.size(), 4U);
  EXPECT_FALSE(moved(scenario, "no.such.key", Direction::up, 0.2));
}

/// What is spread is moved; all at once is a spread of 0, which has no relative step.
TEST(SensitivityLevels, StartsAreSpreadAsLaunchHasThem) {
  EXPECT_EQ(levels(knob_of(scenario_with({}), "deployment.launch")), "– → –");
  const model::config::SpecPath specs{{STORMPROOF_SPECS_DIR}};
  const auto fleet = model::config::read_scenario("fleet-4x2x20", {}, specs);
  ASSERT_TRUE(fleet);
  const Knob knob = knob_of(*fleet, "deployment.launch");
  EXPECT_EQ(knob.value, "process by process, 100ms apart");
  EXPECT_EQ(levels(knob), "process by process, 80ms apart → process by process, 120ms apart");
}

}  // namespace levels_test
}  // namespace stormproof::sensitivity
