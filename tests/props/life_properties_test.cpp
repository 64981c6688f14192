// Properties of participants that forget, fail and come back: rules that are repaired recover
// within the bound in random lives, the paper's rules without a knob do not, and where a property
// says nothing it says why.
#include <set>
#include <string>

#include <gtest/gtest.h>

#include "fsm/composition/effect_mutation.hpp"
#include "model/composition_of.hpp"
#include "model/life.hpp"
#include "props/applicability.hpp"
#include "props/generators/on_demand.hpp"
#include "props/generators/space.hpp"
#include "props/monitors/recovery_bound.hpp"
#include "tests/props/monitored_run.hpp"

namespace stormproof::props {
namespace life_properties_test {

using model::Nanoseconds;
using model::Scenario;

constexpr Nanoseconds ms(std::int64_t count) { return Nanoseconds{count * 1'000'000}; }

/// Three participants on hosts of their own, 1 ms apart.
Scenario trio() {
  Scenario scenario;
  scenario.deployment = model::Deployment::homogeneous(3, 1, 0);
  scenario.wireless.kind = model::ServiceKind::constant_delay;
  scenario.wireless.one_way = ms(1);
  scenario.dds.descriptors.default_publications = 1;
  scenario.dds.descriptors.default_subscriptions = 0;
  model::SedpProfile& sedp = scenario.dds.sedp;
  sedp.piggyback = model::Piggyback::off;
  sedp.relation_opening = model::RelationOpening::each_side;
  sedp.initial_data = model::InitialData::pull;
  sedp.initial_acknack = model::InitialAckNackReply::heartbeat;
  scenario.dds.amendments.emplace();
  scenario.deployment.life.emplace();
  scenario.time_limit = ms(120'000);
  scenario.run_until = model::RunUntil::time_limit;
  return scenario;
}

void repair(Scenario& scenario) {
  model::Amendments& rules = scenario.dds.amendments.emplace();
  rules.initial_acknack_resets = model::Whether::yes;
  rules.initial_acknack_arms = model::Whether::yes;
  rules.initial_acknack_stop = model::InitialAckNackStop::complete;
}

/// What the monitor of the property says of the scenario's run.
std::unique_ptr<Monitor> watched(const std::string& property, const Scenario& scenario,
                                 const model::Mutation* mutation = nullptr) {
  auto monitor = make_monitor(property, scenario);
  model::RunOptions options;
  options.mutation = mutation;
  options.probe = monitor.get();
  options.max_events = 2'000'000;
  EXPECT_NE(model::simulate(scenario, options).end, model::RunEnd::interrupted);
  monitor->finish(scenario.time_limit);
  return monitor;
}

class Recovery : public testing::TestWithParam<int> {};

TEST_P(Recovery, OfRepairedRulesIsWithinTheBoundInRandomLives) {
  int decided = 0;
  for (int k = 0; k < 25; ++k) {
    const auto seed = static_cast<std::uint64_t>(25 * GetParam() + k);
    Scenario scenario = trio();
    Dice dice{seed};
    draw_amendments(dice, scenario);
    repair(scenario);
    scenario.run_until = model::RunUntil::time_limit;
    // Whoever is forgotten sooner than it announces itself is forgotten again and again.
    model::Life& life = *scenario.deployment.life;
    if (life.lease) life.lease = ms(7'000);
    for (model::Lease& lease : life.leases) lease.duration = ms(10'000);
    // A writer that has lost a restarted reader's memory for ever is another matter.
    if (!life.restarts.empty() && !life.lease) life.lease = ms(7'000);
    if (dice.chance(50)) scenario.wireless.lost_packets = {3, 8 + seed % 7, 20 + seed % 11};
    const auto monitor = watched("live.recovery", scenario);
    EXPECT_FALSE(monitor->violation()) << "seed " << seed << ": " << monitor->violation()->reason;
    if (!monitor->is_undecided()) ++decided;
  }
  EXPECT_GE(decided, 20);
}

INSTANTIATE_TEST_SUITE_P(Seeds, Recovery, testing::Range(0, 4));

TEST(Recovery, OfThePapersRulesFails) {
  Scenario scenario = trio();
  scenario.deployment.life->stale = {{0, 1}};
  const auto broken = watched("live.recovery", scenario);
  ASSERT_TRUE(broken->violation());
  EXPECT_NE(broken->violation()->reason.find("still missing"), std::string::npos);
  repair(scenario);
  EXPECT_FALSE(watched("live.recovery", scenario)->violation());
}

TEST(Recovery, OfARunThatIsTooShortIsUndecided) {
  Scenario scenario = trio();
  scenario.deployment.life->stale = {{0, 1}};
  scenario.time_limit = ms(2'000);
  const auto monitor = watched("live.recovery", scenario);
  EXPECT_FALSE(monitor->violation());
  EXPECT_TRUE(monitor->is_undecided());
}

TEST(RecoveryBound, ContainsLeasesAndAnnouncementPeriods) {
  Scenario scenario = trio();
  const Nanoseconds without = recovery_bound(scenario, {}, ms(1));
  scenario.deployment.life->lease = ms(20'000);
  EXPECT_EQ(recovery_bound(scenario, {}, ms(1)), without + ms(20'000));
  scenario.deployment.life->leases = {{1, ms(30'000)}};
  EXPECT_EQ(recovery_bound(scenario, {}, ms(1)), without + ms(30'000));
  const Nanoseconds period = scenario.dds.spdp.period;
  scenario.dds.spdp.period = period + ms(1'000);
  EXPECT_GE(recovery_bound(scenario, {}, ms(1)), without + ms(31'000));
  // The next of attempts that double comes as late again as the last failure.
  EXPECT_EQ(recovery_bound(scenario, ms(5'000), ms(1)),
            recovery_bound(scenario, {}, ms(1)) + ms(5'000));
}

/// If one of these packets is lost, a period that follows the slowest reader breaks isolation; a
/// fixed one never does.
void expect_broken_if_adaptive(Scenario scenario, std::uint64_t first, std::uint64_t end) {
  int broken = 0;
  int broken_if_periodic = 0;
  for (std::uint64_t lost = first; lost < end; ++lost) {
    scenario.wireless.lost_packets = {lost};
    scenario.dds.sedp.heartbeat_policy = model::HeartbeatPolicy::adaptive;
    if (watched("live.isolation", scenario)->violation()) ++broken;
    scenario.dds.sedp.heartbeat_policy = model::HeartbeatPolicy::periodic;
    if (watched("live.isolation", scenario)->violation()) ++broken_if_periodic;
  }
  EXPECT_GT(broken, 0);
  EXPECT_EQ(broken_if_periodic, 0);
}

TEST(Isolation, IsBrokenByAPeriodThatFollowsTheSlowest) {
  Scenario scenario = trio();
  scenario.dds.spdp.startup_announcements = 0;
  scenario.dds.sedp.initial_acknack = model::InitialAckNackReply::bitmap;
  scenario.dds.spdp.resend = model::SpdpResend::new_only;
  scenario.dds.spdp.period = ms(200);
  scenario.deployment.participants[1].start = ms(8'300);
  scenario.deployment.participants[1].endpoints_done = ms(8'300);
  scenario.deployment.life->mute = {{2, Nanoseconds{500'000}}};
  scenario.time_limit = ms(20'000);
  expect_broken_if_adaptive(scenario, 100, 130);
}

/// Three participants of Fast DDS that are 1 ms apart, and what happens to them: who comes back is
/// somebody new, and nobody is forgotten that lives.
Scenario living_fastdds(std::uint64_t seed) {
  Scenario scenario = shipped("rejoin-fastdds", {"deployment.life={}", "run_until=time_limit"});
  Dice dice{seed};
  draw_life(dice, scenario);
  model::Life& life = *scenario.deployment.life;
  life.stale.clear();
  life.leases.clear();
  life.lease = ms(20'000);
  for (model::Restart& restart : life.restarts) restart.identity = model::Identity::fresh;
  return scenario;
}

TEST(FastDdsRecovery, OfWhoIsSomebodyNewIsWithinTheBound) {
  int decided = 0;
  for (std::uint64_t seed = 1; seed <= 60; ++seed) {
    const auto monitor = watched("live.recovery", living_fastdds(seed));
    EXPECT_FALSE(monitor->violation()) << "seed " << seed << ": " << monitor->violation()->reason;
    if (!monitor->is_undecided()) ++decided;
  }
  EXPECT_GE(decided, 50);
}

/// Issue 6401: who forgot another one may never be served again.
TEST(FastDdsRecovery, OfWhoForgotIsNotCertain) {
  Scenario scenario = shipped("rejoin-fastdds", {"run_until=time_limit"});
  EXPECT_TRUE(watched("live.recovery", scenario)->violation());
  scenario.dds.sedp.piggyback = model::Piggyback::off;
  EXPECT_FALSE(watched("live.recovery", scenario)->violation());
}

/// Effects without which some run is not complete in time.
TEST(FastDdsRecovery, MistakesInLivesAreNoticed) {
  const std::set<std::string> needed{"Forget.1", "ForgetReader.1", "ForgetReader.2",
                                     "ForgetWriter.3", "Returns.2"};
  std::set<std::string> noticed;
  const auto& living = model::composition_of(living_fastdds(1));
  for (const auto& mistake : fsm::composition::effect_mutations(living)) {
    using Change = fsm::composition::EffectMutation::Change;
    if (mistake.change != Change::drop || !needed.contains(mistake.effect)) continue;
    model::Mutation mutation;
    mutation.effects.push_back(mistake);
    for (std::uint64_t seed = 1; seed <= 20 && !noticed.contains(mistake.effect); ++seed) {
      Scenario scenario = living_fastdds(seed);
      for (model::Restart& restart : scenario.deployment.life->restarts) {
        restart.identity = model::Identity::same;
        restart.start = restart.stop + ms(30'000);
      }
      if (watched("live.recovery", scenario)->violation()) continue;
      if (watched("live.recovery", scenario, &mutation)->violation())
        noticed.insert(mistake.effect);
    }
  }
  EXPECT_EQ(noticed, needed);
}

/// Three participants of Cyclone DDS, and what happens to them.
Scenario living_cyclone(std::uint64_t seed, const std::string& profile) {
  Scenario scenario =
      shipped("rejoin-fastdds", {"deployment.life={}", "run_until=time_limit", "dds=" + profile});
  Dice dice{seed};
  draw_life(dice, scenario);
  model::Life& life = *scenario.deployment.life;
  life.stale.clear();
  life.leases.clear();
  life.lease.reset();
  life.endpoints.clear();
  for (model::Restart& restart : life.restarts) restart.identity = model::Identity::fresh;
  return scenario;
}

TEST(CycloneRecovery, IsWithinTheBoundInRandomLives) {
  int decided = 0;
  for (std::uint64_t seed = 1; seed <= 40; ++seed) {
    const auto scenario =
        living_cyclone(seed, seed % 2 == 0 ? "cyclonedds-0.10" : "cyclonedds-0.10-multicast");
    const auto monitor = watched("live.recovery", scenario);
    EXPECT_FALSE(monitor->violation()) << "seed " << seed << ": " << monitor->violation()->reason;
    if (!monitor->is_undecided()) ++decided;
  }
  EXPECT_GE(decided, 35);
}

/// 11 without multicast, an outage of 45 s: exhibit E18.
TEST(CycloneRecovery, OfElevenWithoutMulticastFails) {
  Scenario scenario =
      shipped("rejoin-fastdds", {"deployment.life={}", "run_until=time_limit", "time_limit=300s",
                                 "dds={base: cyclonedds-11, allow_multicast: false, peers: 1}"});
  scenario.deployment.life->outages = {
      {0, 0, ms(12'000), ms(57'000), model::Reach::all, model::Reach::all}};
  const auto never = watched("live.recovery", scenario);
  ASSERT_TRUE(never->violation());
  EXPECT_NE(never->violation()->reason.find("nothing more is learned"), std::string::npos);
  scenario.dds.spdp.period = ms(5'000);
  EXPECT_FALSE(watched("live.recovery", scenario)->violation());
}

/// Two clients on another host and one beside each of the servers, and what happens to them.
Scenario with_servers(const std::string& servers, const std::string& life,
                      const std::vector<std::string>& more = {}) {
  std::vector<std::string> overrides{
      "dds=fastdds-server-2.14.5",
      "run_until=time_limit",
      "time_limit=200s",
      "deployment.servers=[" + servers + "]",
      "deployment.life={" + life + "}",
      "deployment.participants=[{host: 1, publications: 1, subscriptions: 1, start: 1s}, "
      "{host: 1, publications: 1, subscriptions: 1, start: 2400ms}, "
      "{host: 0, publications: 1, subscriptions: 1, start: 1900ms}]"};
  overrides.insert(overrides.end(), more.begin(), more.end());
  return shipped("rejoin-fastdds", overrides);
}
const std::string redundant = "{host: 0}, {host: 1}";

/// What passes: outages of every length, deaths, and one of a pair of servers that dies.
TEST(ServerRecovery, IsWithinTheBound) {
  for (const char* length : {"12s", "27s", "29s", "35s", "60s"}) {
    const std::string times = std::string{", start: 10s, end: "} + length + "}";
    const std::string cut = "outages: [{from: 1, from_reach: host, to: 0, to_reach: all" + times +
                            ", {from: 0, from_reach: all, to: 1, to_reach: host" + times + "]";
    const auto monitor = watched("live.recovery", with_servers("{host: 0}", cut));
    EXPECT_FALSE(monitor->violation()) << length << ": " << monitor->violation()->reason;
    EXPECT_FALSE(monitor->is_undecided());
  }
  for (const char* life :
       {"mute: [{participant: 0, from: 10s}]", "mute: [{participant: 3, from: 10s}]",
        "restarts: [{participant: 3, stop: 10s, start: 12s}]"}) {
    const auto monitor = watched("live.recovery", with_servers(redundant, life));
    EXPECT_FALSE(monitor->violation()) << life << ": " << monitor->violation()->reason;
    EXPECT_FALSE(monitor->is_undecided());
  }
}

/// Who dies while no server lives: exhibit E21; a client that is dropped: E22.
TEST(ServerRecovery, OfGhostsAndOfTheDroppedFails) {
  const std::string deaths =
      "restarts: [{participant: 3, stop: 10s, start: 45s}], mute: [{participant: 0, from: 12s}]";
  EXPECT_TRUE(watched("live.recovery", with_servers("{host: 0}", deaths))->violation());
  EXPECT_FALSE(watched("live.recovery", with_servers(redundant, deaths))->violation());
  const std::string cut =
      "outages: [{from: 1, from_reach: host, to: 0, to_reach: all, start: 10s, end: 28400ms}, "
      "{from: 0, from_reach: all, to: 1, to_reach: host, start: 10s, end: 28400ms}]";
  const auto known = with_servers("{host: 0}", cut);
  EXPECT_FALSE(watched("live.recovery", known)->violation());
  const auto dropped = with_servers("{host: 0}", cut, {"dds.rejoin=dropped"});
  EXPECT_TRUE(watched("live.recovery", dropped)->violation());
}

TEST(FastDdsIsolation, IsBrokenByAPeriodThatFollowsTheSlowest) {
  Scenario scenario =
      shipped("rejoin-fastdds", {"run_until=time_limit", "time_limit=20s", "dds.sedp.piggyback=off",
                                 "dds.spdp.period=200ms"});
  scenario.deployment.life = model::Life{};
  scenario.deployment.life->mute = {{2, Nanoseconds{2'500'000}}};
  model::Participant& late = scenario.deployment.participants[1];
  late.endpoints_done += ms(8'300);
  late.start += ms(8'300);
  expect_broken_if_adaptive(scenario, 115, 140);
}

TEST(LifeProperties, SayWhereTheySayNothing) {
  Scenario scenario = trio();
  const auto why = [&](std::string_view property) {
    return std::string{applicability_of(property, scenario).why_not};
  };
  EXPECT_NE(why("live.recovery").find("nobody forgets"), std::string::npos);
  EXPECT_NE(why("live.isolation").find("nobody falls silent"), std::string::npos);
  scenario.deployment.life->mute = {{2, ms(5)}};
  EXPECT_EQ(why("live.recovery"), "");
  EXPECT_EQ(why("live.isolation"), "");
  scenario.wireless = {};
  EXPECT_EQ(why("live.recovery"), "");
  EXPECT_NE(why("live.isolation").find("constant delays"), std::string::npos);
  EXPECT_EQ(why("safety.ack-stable"), "");
  EXPECT_EQ(why("storm.join-cost"), "");
  EXPECT_NE(why("live.no-stall"), "");
  scenario.deployment.life.reset();
  scenario.dds = {};
  scenario.dds.implementation = model::ImplementationKind::fastdds;
  EXPECT_NE(why("storm.join-cost"), "");
  EXPECT_EQ(why("storm.feedback-gain"), "");
  EXPECT_EQ(why("timer.progress"), "");
  EXPECT_NE(why("live.recovery"), "");
  scenario.deployment.life.emplace();
  EXPECT_NE(why("live.recovery").find("nobody forgets"), std::string::npos);
  EXPECT_NE(why("live.completion"), "");
  scenario.deployment.life->mute = {{2, ms(5)}};
  EXPECT_EQ(why("composition.followed"), "");
  EXPECT_EQ(why("live.recovery"), "");
  EXPECT_NE(why("live.isolation").find("constant delays"), std::string::npos);
  scenario.dds.implementation = model::ImplementationKind::cyclone;
  EXPECT_EQ(why("live.recovery"), "");
  EXPECT_NE(why("live.isolation"), "");
  scenario.dds = {};
  scenario.dds.implementation = model::ImplementationKind::fastdds;
  scenario.dds.discovery = model::Discovery::server;
  EXPECT_EQ(why("live.recovery"), "");
  EXPECT_NE(why("live.isolation"), "");
}

}  // namespace life_properties_test
}  // namespace stormproof::props
