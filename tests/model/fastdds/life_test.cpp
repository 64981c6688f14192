// Participants of Fast DDS that forget each other and come back (specs/guide/museum.md, "Lives
// under Fast DDS"), issue 6401 among them (specs/findings/6401.md), and who may have a life at all.
#include "model/life.hpp"

#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "model/config/knobs/numeric_knobs.hpp"
#include "model/config/scenario_file.hpp"
#include "model/simulator.hpp"
#include "props/applicability.hpp"

namespace stormproof::model::fastdds {
namespace life_test {

Scenario rejoin(const std::vector<std::string>& overrides = {}) {
  return *config::read_scenario("rejoin-fastdds", overrides, config::SpecPath::standard());
}

TEST(FastDdsRejoin, AHeartbeatForSomebodyElseCancelsIt) {
  const RunResult run = simulate(rejoin());
  EXPECT_EQ(run.end, RunEnd::no_more_events);
  EXPECT_FALSE(run.completed());
  EXPECT_EQ(run.missing_count, 18U);
  for (const MissingDescriptor& missing : run.missing) {
    EXPECT_EQ(missing.source.value, 0U);
    EXPECT_EQ(missing.destination.value, 1U);
    EXPECT_EQ(missing.stream, Stream::sub);
  }
}

/// Each thing that has to come together is needed: who forgot, the third one, and the charge.
TEST(FastDdsRejoin, SucceedsOtherwise) {
  EXPECT_TRUE(simulate(rejoin({"deployment.life.stale=[]"})).completed());
  EXPECT_TRUE(simulate(rejoin({"deployment.participants.2.start=1s"})).completed());
  EXPECT_TRUE(simulate(rejoin({"dds=fastdds-2.6.11-sndbuf4M"})).completed());
  EXPECT_TRUE(simulate(rejoin({"dds.sedp.piggyback=off"})).completed());
}

/// The initial ACKNACK of who forgot takes the acknowledgments back.
TEST(FastDdsRejoin, AsksAgain) {
  const RunResult run = simulate(rejoin({"dds.sedp.piggyback=off"}));
  EXPECT_EQ(run.recovery_time, run.discovery_time);
  EXPECT_GT(*run.discovery_time, Nanoseconds{71'000'000});
  EXPECT_FALSE(simulate(rejoin({"dds.sedp.piggyback=off", "dds.sedp.initial_acknack_delay=0ms"}))
                   .completed());
}

TEST(FastDdsRestart, IsARecovery) {
  const std::vector<std::string> common{"run_until=completion", "dds.sedp.piggyback=off"};
  for (const std::string identity : {"same", "new"}) {
    std::vector<std::string> overrides = common;
    overrides.push_back(
        "deployment.life={lease: 20s, restarts: [{participant: 1, stop: 30s, start: 40s, "
        "identity: " +
        identity + "}]}");
    const RunResult run = simulate(rejoin(overrides));
    EXPECT_TRUE(run.completed()) << identity;
    ASSERT_TRUE(run.recovery_time) << identity;
    EXPECT_GT(*run.recovery_time, Nanoseconds{}) << identity;
  }
}

TEST(FastDdsLife, NeedsRulesThatKnowIt) {
  Scenario scenario = rejoin();
  EXPECT_TRUE(config::is_valid(scenario));
  scenario.wireless.sender = Sender::stalls;
  EXPECT_FALSE(config::is_valid(scenario));
  scenario = rejoin();
  scenario.dds.discovery = Discovery::static_peers;
  EXPECT_FALSE(config::is_valid(scenario));
}

/// No bound or theorem says anything of it.
TEST(FastDdsLife, IsUnknownToEngines) {
  Scenario scenario = rejoin();
  EXPECT_NE(props::applicability_of("live.completion", scenario).why_not, "");
  EXPECT_NE(props::applicability_of("live.completion", scenario).why_not_provable, "");
  EXPECT_EQ(props::applicability_of("order.total", scenario).why_not, "");
  scenario.deployment.life.reset();
  EXPECT_EQ(props::applicability_of("live.completion", scenario).why_not, "");
  EXPECT_EQ(props::applicability_of("live.completion", scenario).why_not_provable, "");
}

}  // namespace life_test
}  // namespace stormproof::model::fastdds
