// Participants that are forgotten and come back (specs/guide/museum.md, "Participants that come and
// go"): the relations that museum exhibits take as given are reached by outages and restarts.
#include "model/life.hpp"

#include <gtest/gtest.h>

#include "tests/model/run_log.hpp"

namespace stormproof::model {
namespace life_test {

/// Two participants with the rules of Fast DDS before its repair of 2017, and an empty life.
Scenario pair_of_participants() {
  Scenario scenario;
  scenario.dds.descriptors.default_publications = 1;
  scenario.dds.descriptors.default_subscriptions = 0;
  scenario.dds.spdp.resend = SpdpResend::new_only;
  scenario.dds.spdp.startup_announcements = 0;
  scenario.dds.spdp.period = Nanoseconds{3 * sec};
  SedpProfile& sedp = scenario.dds.sedp;
  sedp.piggyback = Piggyback::off;
  sedp.relation_opening = RelationOpening::each_side;
  sedp.initial_data = InitialData::pull;
  sedp.unmatched = Unmatched::drop;
  sedp.initial_acknack = InitialAckNackReply::heartbeat;
  sedp.acknowledge = Acknowledge::prefix;
  sedp.heartbeat_recipients = HeartbeatRecipients::matched;
  scenario.dds.amendments.emplace();
  scenario.wireless.kind = ServiceKind::constant_delay;
  scenario.wireless.one_way = Nanoseconds{ms};
  for (std::uint32_t i = 0; i < 2; ++i) {
    scenario.deployment.participants.push_back({HostId{i}, 0, 0, {}, {}});
  }
  scenario.deployment.life.emplace();
  scenario.time_limit = Nanoseconds{120 * sec};
  return scenario;
}

Life& life(Scenario& scenario) { return *scenario.deployment.life; }

/// Neither hears the other.
void separate(Scenario& scenario, std::int64_t start, std::int64_t end) {
  life(scenario).outages.push_back({0, 1, Nanoseconds{start}, Nanoseconds{end}});
  life(scenario).outages.push_back({1, 0, Nanoseconds{start}, Nanoseconds{end}});
}

/// Fast DDS #155 from its beginning: one lease is shorter than the outage, the other one longer.
TEST(ParticipantsComeAndGo, UnequalLeasesMakeAReaderThatNobodyServes) {
  Scenario scenario = pair_of_participants();
  life(scenario).lease = Nanoseconds{20 * sec};
  life(scenario).leases = {{0, Nanoseconds{5 * sec}}};
  separate(scenario, 30 * sec, 40 * sec);
  const RunResult before = simulate(scenario);
  EXPECT_FALSE(before.completed());
  EXPECT_FALSE(before.recovery_time);
  ASSERT_EQ(before.missing.size(), 1U);
  EXPECT_EQ(before.missing[0].source.value, 0U);
  scenario.dds.amendments->initial_acknack_resets = Whether::yes;
  const RunResult after = simulate(scenario);
  EXPECT_TRUE(after.completed());
}

TEST(ParticipantsComeAndGo, WhoComesBackUnderItsNameIsOneThatForgot) {
  Scenario scenario = pair_of_participants();
  life(scenario).restarts = {{1, Nanoseconds{10 * sec}, Nanoseconds{11 * sec}, Identity::same}};
  EXPECT_FALSE(simulate(scenario).completed());
  scenario.dds.amendments->initial_acknack_resets = Whether::yes;
  Nanoseconds last;
  for (const std::uint32_t count : {0U, 1U, 3U, 6U}) {  // Fast DDS #1534
    scenario.dds.amendments->count_filter = count;
    const RunResult result = simulate(scenario);
    ASSERT_TRUE(result.recovery_time) << count;
    EXPECT_GT(*result.recovery_time, last) << count;
    last = *result.recovery_time;
  }
  EXPECT_GT(last, Nanoseconds{8 * sec});
}

TEST(ParticipantsComeAndGo, ARunUntilQuiescenceEndsWhenNothingIsLeftToDo) {
  Scenario scenario = pair_of_participants();
  const RunResult complete = simulate(scenario);
  scenario.run_until = RunUntil::quiescence;
  const RunResult quiet = simulate(scenario);
  EXPECT_EQ(quiet.discovery_time, complete.discovery_time);
  EXPECT_EQ(quiet.end, RunEnd::no_more_events);
  EXPECT_GT(quiet.end_time, complete.end_time);
  EXPECT_LT(quiet.end_time, Nanoseconds{10 * sec});
}

TEST(ParticipantsComeAndGo, RestartsOfOneParticipantFollowEachOther) {
  Scenario scenario = pair_of_participants();
  const auto at = [](std::int64_t seconds) { return Nanoseconds{seconds * sec}; };
  life(scenario).restarts = {{1, at(5), at(6), Identity::same}, {1, at(1), at(2), Identity::same}};
  EXPECT_TRUE(comes_back_in_order(scenario.deployment));
  life(scenario).restarts.push_back({1, at(4), at(7), Identity::same});
  EXPECT_FALSE(comes_back_in_order(scenario.deployment));
  life(scenario).restarts = {{1, at(1), at(2), Identity::fresh}, {1, at(5), at(6), {}}};
  EXPECT_FALSE(comes_back_in_order(scenario.deployment));
  life(scenario).restarts = {{1, at(1), at(2), Identity::same}};
  scenario.deployment.participants[1].start = at(3);
  EXPECT_FALSE(comes_back_in_order(scenario.deployment));
}

}  // namespace life_test
}  // namespace stormproof::model
