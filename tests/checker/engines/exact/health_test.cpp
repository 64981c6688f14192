// Storm, slow link, waiting, fine: told apart by what feedback costs and from the last start on.
#include "checker/engines/exact/health.hpp"

#include <gtest/gtest.h>

#include "model/simulator.hpp"
#include "tests/props/monitored_run.hpp"

namespace stormproof::exact {
namespace health_test {

using model::Nanoseconds;
using props::shipped;

RunHealth health(const char* name, const std::vector<std::string>& overrides = {}) {
  const model::Scenario scenario = shipped(name, overrides);
  return health_of(scenario, model::simulate(scenario));
}

/// Who comes back after 30 s and is there after 75 ms was not slow.
TEST(Health, CountsFromTheEndOfTheLastFailure) {
  model::Scenario scenario;
  scenario.deployment = model::Deployment::homogeneous(2, 1, 1);
  scenario.dds.amendments.emplace();
  scenario.wireless.kind = model::ServiceKind::constant_delay;
  scenario.wireless.one_way = Nanoseconds{1'000'000};
  scenario.time_limit = Nanoseconds{60'000'000'000};
  model::Life& life = scenario.deployment.life.emplace();
  life.lease = Nanoseconds{5'000'000'000};
  life.restarts = {{1, Nanoseconds{10'000'000'000}, Nanoseconds{30'000'000'000}}};
  const RunHealth run = health_of(scenario, model::simulate(scenario));
  ASSERT_TRUE(run.completion);
  EXPECT_GT(*run.completion, Nanoseconds{30'000'000'000});
  EXPECT_EQ(run.last_start, Nanoseconds{30'000'000'000});
  EXPECT_EQ(run.took, *run.completion - run.last_start);
  EXPECT_EQ(run.health, Health::fine);
  EXPECT_NE(Outlook{{run}}.sentence().find("after the last failure or start"), std::string::npos);
}

/// Complete again before the limit; the run goes on, since leases may still end. It was judged for
/// ever: a run that ends with the discovery was asked for, and again.
TEST(Health, ARunThatMayStillForgetIsJudgedOnce) {
  model::Scenario scenario = shipped("smallest", {"dds=fastdds-2.14.5"});
  scenario.time_limit = Nanoseconds{10'000'000'000};
  model::Life& life = scenario.deployment.life.emplace();
  life.lease = Nanoseconds{20'000'000'000};
  life.outages = {
      {.from = 0, .to = 1, .start = Nanoseconds{5'000'000'000}, .end = Nanoseconds{6'000'000'000}}};
  const model::RunResult result = model::simulate(scenario);
  ASSERT_TRUE(result.completed());
  EXPECT_EQ(result.end, model::RunEnd::time_limit);
  const RunHealth run = health_of(scenario, result);
  EXPECT_EQ(run.completion, result.discovery_time);
  EXPECT_EQ(run.health, Health::fine);
}

TEST(Health, ShippedScenariosAreWhatTheirNamesSay) {
  EXPECT_EQ(health("smallest").health, Health::fine);
  EXPECT_EQ(health("wired-5x20").health, Health::fine);
  EXPECT_EQ(health("wifi-5x20-tuned").health, Health::fine);
  EXPECT_EQ(health("wifi-5x20").health, Health::storm);
  EXPECT_EQ(health("high-load-6x30").health, Health::storm);
}

/// Most of what a server sends is relayed for the first time.
TEST(Health, AServerIsJudgedByTheSameDefinition) {
  const RunHealth busy = health("wifi-5x20-fastdds", {"dds=fastdds-server-2.6.11"});
  EXPECT_EQ(busy.health, Health::slow_link) << busy.needless;
  EXPECT_GT(busy.needless, 0.1);
  EXPECT_LT(busy.needless, 1);
  EXPECT_FALSE(busy.stretch) << "a server has no open loop";
  EXPECT_TRUE(busy.airtime);
  const RunHealth fine = health("smallest", {"dds=fastdds-server-2.6.11"});
  EXPECT_EQ(fine.health, Health::fine) << fine.took.count();
}

TEST(Health, WithoutARepeatThereIsNoStorm) {
  const RunHealth once = health("wifi-5x20-fastdds", {"deployment.participants_per_host=1",
                                                      "deployment.endpoints_per_participant=100"});
  EXPECT_EQ(once.health, Health::fine) << once.needless;
  EXPECT_DOUBLE_EQ(once.needless, 0);
}

TEST(Health, TheScenariosLimitsSayWhatAStormIs) {
  EXPECT_NE(health("wifi-5x20", {"limits.needless=1000"}).health, Health::storm);
  EXPECT_NE(health("wifi-5x20", {"limits.late=100s"}).health, Health::storm);
}

TEST(Health, ALateJoinerIsNoStorm) {
  const RunHealth run = health("staggered-joins");
  EXPECT_EQ(run.health, Health::fine);
  EXPECT_EQ(run.last_start, Nanoseconds{2'000'000'000});
  EXPECT_EQ(run.took, *run.completion - run.last_start);
}

TEST(Health, AChannelThatIsSlowIsNoStorm) {
  // Everything is sent about once, and that takes its time.
  const RunHealth run = health("wifi-5x20-tuned", {"limits.completion=1s"});
  EXPECT_EQ(run.health, Health::slow_link) << run.airtime.value_or(-1) << " " << run.took.count();
}

TEST(Health, WaitingForATimerIsNoStorm) {
  const RunHealth run = health(
      "wired-5x20", {"deployment.hosts=2", "deployment.participants_per_host=1",
                     "wireless.lost_packets=[0, 1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11, 12, 13, 14, 15]",
                     "dds.spdp.startup_period=2s"});
  EXPECT_EQ(run.health, Health::waiting) << run.took.count();
}

TEST(Health, OfARunThatIsNotCompleteTheMissingAreCounted) {
  const RunHealth run = health("smallest", {"time_limit=1ms"});
  EXPECT_EQ(run.health, Health::incomplete);
  EXPECT_EQ(run.missing, 38U);
  EXPECT_EQ(run.took, Nanoseconds{1'000'000});
}

TEST(Health, WhatHappensAfterDiscoveryDoesNotCount) {
  const RunHealth alone = health("smallest");
  const RunHealth longer = health("smallest", {"run_until=time_limit", "time_limit=5s"});
  EXPECT_EQ(longer.airtime, alone.airtime);
  EXPECT_EQ(longer.busy, alone.busy);
}

TEST(Health, TheScenariosLimitSaysWhatIsLate) {
  EXPECT_EQ(health("smallest", {"limits.completion=10ms"}).health, Health::slow_link);
  EXPECT_EQ(health("smallest", {"limits.completion=17ms"}).health, Health::fine);
}

RunHealth one(Health kind, std::int64_t took) {
  RunHealth run;
  run.health = kind;
  run.took = Nanoseconds{took};
  if (kind != Health::incomplete) run.completion = run.took;
  return run;
}

TEST(Outlook, TheMedianAndTheRangeAreThoseOfTheRuns) {
  const Outlook outlook{{one(Health::fine, 3), one(Health::storm, 9), one(Health::fine, 1)}};
  EXPECT_EQ(outlook.median().took, Nanoseconds{3});
  EXPECT_EQ(outlook.best().took, Nanoseconds{1});
  EXPECT_EQ(outlook.worst().took, Nanoseconds{9});
  EXPECT_EQ(outlook.headline(), "STORM in 1 of 3 runs");
}

TEST(Outlook, WhatIsNotCompleteIsWorseThanEverythingThatIs) {
  const Outlook outlook{{one(Health::incomplete, 2), one(Health::fine, 100)}};
  EXPECT_FALSE(outlook.worst().completion);
  EXPECT_EQ(outlook.completed(), 1U);
  EXPECT_EQ(outlook.headline(), "INCOMPLETE in 1 of 2 runs");
  EXPECT_EQ(outlook.sentence(), "discovery does not complete in 1 of 2 runs");
}

}  // namespace health_test
}  // namespace stormproof::exact
