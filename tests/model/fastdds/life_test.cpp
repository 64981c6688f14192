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
  EXPECT_TRUE(config::is_valid(scenario));
  scenario.dds.discovery = Discovery::server;
  EXPECT_FALSE(config::is_valid(scenario));  // nobody knows anybody before the run
  scenario.deployment.life->stale.clear();
  EXPECT_TRUE(config::is_valid(scenario));
}

// Two participants, two user endpoints each, that start at 0 and at 0.5 s; every packet takes 0.1
// ms: the cases that are worked out by hand in specs/guide/museum.md.

constexpr std::int64_t us = 1'000;
constexpr std::int64_t ms = 1'000 * us;

Scenario two(const std::string& profile, const std::vector<std::string>& more) {
  std::vector<std::string> overrides{
      "dds=" + profile,
      "deployment.participants=[{host: 0, publications: 1, subscriptions: 1}, {host: 1, "
      "publications: 1, subscriptions: 1, start: 500ms}]",
      "wireless={kind: constant_delay, one_way: 100us}", "run_until=time_limit"};
  overrides.insert(overrides.end(), more.begin(), more.end());
  return rejoin(overrides);
}
std::string life(const std::string& what) { return "deployment.life={" + what + "}"; }
std::optional<std::int64_t> complete_at_us(const Scenario& scenario) {
  const RunResult run = simulate(scenario);
  if (!run.discovery_time) return {};
  EXPECT_EQ(run.discovery_time->count() % us, 0);
  return run.discovery_time->count() / us;
}
const std::string one_way = "{from: 0, to: 1, start: 9900ms, end: 39900ms}";
const std::string both_ways =
    "outages: [" + one_way + ", {from: 1, to: 0, start: 9900ms, end: 39900ms}]";

/// The lease is the library's own, though nobody has written it down: 0 forgets 1 at 27.0, 1
/// forgets 0 at 29.5, and 1's announcement at 40.0 is the first that arrives.
TEST(FastDdsOutage, EndsWithTheNextAnnouncement) {
  EXPECT_EQ(complete_at_us(two("fastdds-2.6.11", {life(both_ways)})), 40'000'610);
  EXPECT_EQ(complete_at_us(two("fastdds-2.14.5", {life(both_ways)})), 40'110'500);
  EXPECT_EQ(complete_at_us(two("fastdds-static-2.6.11", {life(both_ways)})), 40'000'610);
}
/// 1 forgets 0 at 29.5, 0 forgets nobody; 0 announces itself at 42.5.
TEST(FastDdsOutage, OfOneDirectionIsForgottenByOneSide) {
  const std::string cut = "outages: [" + one_way + "]";
  EXPECT_EQ(complete_at_us(two("fastdds-2.6.11", {life(cut)})), 42'570'610);
  EXPECT_EQ(complete_at_us(two("fastdds-2.14.5", {life(cut)})), 42'680'500);
}
/// Ordered pairs of which one forgot the other, as under Cyclone DDS.
TEST(FastDdsOutage, SaysHowManyForget) {
  const auto forgotten = [](const std::string& what) {
    return simulate(two("fastdds-2.6.11", {life(what)})).until_discovery.value().forgotten;
  };
  EXPECT_EQ(forgotten(both_ways), 2U);
  EXPECT_EQ(forgotten("outages: [" + one_way + "]"), 1U);
  // Who comes back has lost all that it had, and forgets nobody.
  EXPECT_EQ(forgotten("restarts: [{participant: 1, stop: 5s, start: 6s}]"), 0U);
  EXPECT_EQ(forgotten("restarts: [{participant: 1, stop: 5s, start: 6s, identity: new}]"), 1U);
}
TEST(FastDdsOutage, OfFifteenSecondsCostsNothing) {
  const std::string cut =
      "outages: [{from: 0, to: 1, start: 9900ms, end: 24900ms}, {from: 1, to: 0, start: 9900ms, "
      "end: 24900ms}]";
  const RunResult run = simulate(two("fastdds-2.6.11", {life(cut)}));
  EXPECT_EQ(run.recovery_time, Nanoseconds{});
  EXPECT_EQ(run.counts.initial_data,
            simulate(two("fastdds-2.6.11", {life("")})).counts.initial_data);
}
/// 1 last hears 0 at 6.5; its successor is complete long before that is forgotten.
TEST(FastDdsDeath, IsOverWhenTheLeaseIs) {
  const std::string death =
      "restarts: [{participant: 0, stop: 8s, start: 10s, identity: new}], lease: ";
  EXPECT_EQ(complete_at_us(two("fastdds-2.6.11", {life(death + "20s")})), 26'500'100);
  EXPECT_EQ(complete_at_us(two("fastdds-2.6.11", {life("mute: [{participant: 0, from: 8s}]")})),
            26'500'100);
}
/// The only answer to its first announcement comes before 1 listens; 0 announces itself at 3.5.
TEST(FastDdsStart, MissesAnAnswerBeforeItIsReady) {
  const auto ready_after = [](const std::string& time) {
    Scenario scenario = two("fastdds-2.6.11", {life(""), "dds.spdp.startup_announcements=0"});
    scenario.deployment.participants[1].ready = scenario.deployment.participants[1].start +
                                                Nanoseconds{time == "200us" ? 200 * us : 201 * us};
    return complete_at_us(scenario);
  };
  EXPECT_LT(*ready_after("200us"), 1'000'000);
  EXPECT_GT(*ready_after("201us"), 3'000'000);
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
