// The amended rules of the paper's implementation (specs/guide/museum.md): instants and counts of
// runs that an independent probe of the same rules gave, for exhibits of the museum.
#include <functional>
#include <optional>

#include <gtest/gtest.h>

#include "tests/model/run_log.hpp"
#include "tests/oracle/random_scenario.hpp"

namespace stormproof::model {
namespace amended_test {

/// Participants on different hosts with one publication each.
Scenario base(std::uint32_t participants, std::int64_t delay_ns = ms) {
  Scenario scenario;
  scenario.dds.descriptors.default_publications = 1;
  scenario.dds.descriptors.default_subscriptions = 0;
  scenario.dds.sedp.piggyback = Piggyback::off;
  scenario.dds.spdp.resend = SpdpResend::new_only;
  scenario.dds.spdp.startup_announcements = 0;
  scenario.dds.amendments.emplace();
  scenario.wireless.kind = ServiceKind::constant_delay;
  scenario.wireless.one_way = Nanoseconds{delay_ns};
  for (std::uint32_t i = 0; i < participants; ++i) {
    scenario.deployment.participants.push_back({HostId{i}, 0, 0, {}, {}});
  }
  scenario.time_limit = Nanoseconds{12 * sec};
  return scenario;
}

/// As Fast DDS has them.
Scenario each_side(Scenario scenario) {
  SedpProfile& sedp = scenario.dds.sedp;
  sedp.relation_opening = RelationOpening::each_side;
  sedp.initial_data = InitialData::pull;
  return scenario;
}
Scenario as_fastdds(Scenario scenario) {
  scenario = each_side(std::move(scenario));
  SedpProfile& sedp = scenario.dds.sedp;
  sedp.unmatched = Unmatched::drop;
  sedp.initial_acknack = InitialAckNackReply::heartbeat;
  sedp.acknowledge = Acknowledge::prefix;
  sedp.heartbeat_recipients = HeartbeatRecipients::matched;
  return scenario;
}

Amendments& rules(Scenario& scenario) { return *scenario.dds.amendments; }

void is_stale(Scenario& scenario, std::uint32_t writer, std::uint32_t reader) {
  if (!scenario.deployment.life) scenario.deployment.life.emplace();
  scenario.deployment.life->stale.push_back({writer, reader});
}

/// When discovery is complete, µs; nothing if it never is.
std::optional<double> completion_us(const Scenario& scenario) {
  const RunResult result = simulate(scenario);
  if (!result.discovery_time) return std::nullopt;
  return static_cast<double>(result.discovery_time->count()) / 1'000;
}

/// With all knobs at their defaults the amended rules are the paper's.
TEST(Amended, AreThePapersIfNothingIsAmended) {
  for (const bool fastdds : {false, true}) {
    Scenario amended = base(3);
    if (fastdds) amended = as_fastdds(std::move(amended));
    amended.dds.sedp.piggyback = Piggyback::cumulative;
    amended.dds.sedp.piggyback_threshold_bytes = Bytes{3'000};
    amended.dds.descriptors.default_publications = 9;
    amended.wireless.lost_packets = {3, 11, 12, 40};
    amended.run_until = RunUntil::time_limit;
    Scenario plain = amended;
    plain.dds.amendments.reset();
    const RunLog one = run_and_log(amended);
    const RunLog other = run_and_log(plain);
    EXPECT_EQ(one.result.events, other.result.events);
    EXPECT_EQ(one.result.discovery_time, other.result.discovery_time);
    ASSERT_EQ(one.sent.size(), other.sent.size());
    for (std::size_t k = 0; k < one.sent.size(); ++k) {
      EXPECT_EQ(one.sent[k].time_ns, other.sent[k].time_ns);
      EXPECT_EQ(one.sent[k].kind, other.sent[k].kind);
      EXPECT_EQ(one.sent[k].descriptors, other.sent[k].descriptors);
    }
  }
}

/// In any scenario, whatever the channel, the policy, and the order of things.
TEST(Amended, AreThePapersInRandomScenarios) {
  std::size_t completed = 0;
  for (std::uint64_t seed = 1; seed <= 150; ++seed) {
    const Scenario plain = oracle::random_scenario(seed, ImplementationKind{});
    Scenario amended = plain;
    amended.dds.amendments.emplace();
    RunOptions options;
    options.max_events = 20'000;
    const RunResult one = simulate(plain, options);
    const RunResult other = simulate(amended, options);
    EXPECT_EQ(one.events, other.events) << seed;
    EXPECT_EQ(one.end_time, other.end_time) << seed;
    EXPECT_EQ(one.discovery_time, other.discovery_time) << seed;
    EXPECT_EQ(one.counts, other.counts) << seed;
    completed += one.completed() ? 1U : 0U;
  }
  EXPECT_GT(completed, 50U);
}

Scenario forgotten() {
  Scenario scenario = as_fastdds(base(2));
  is_stale(scenario, 0, 1);
  return scenario;
}

TEST(Amended, AWriterThatForgetsWithItsReaderServesItAgain) {  // E0
  Scenario scenario = forgotten();
  EXPECT_EQ(completion_us(scenario), std::nullopt);
  rules(scenario).initial_acknack_resets = Whether::yes;
  EXPECT_EQ(completion_us(scenario), 75'110);
}

TEST(Amended, InitialAckNacksAreRepeated) {  // E1
  Scenario scenario = forgotten();
  rules(scenario).initial_acknack_resets = Whether::yes;
  scenario.wireless.lost_packets = {8};
  EXPECT_EQ(completion_us(scenario), 215'110);
  scenario.dds.sedp.initial_acknack_interval = InitialAckNackInterval::constant;
  EXPECT_EQ(completion_us(scenario), 145'110);
  rules(scenario).initial_acknack_repeat = InitialAckNackRepeat::once;
  EXPECT_EQ(completion_us(scenario), std::nullopt);
}

TEST(Amended, TheHeartbeatThatAnswersAnInitialAckNackArmsTheTimer) {  // E2
  Scenario scenario = forgotten();
  rules(scenario).initial_acknack_resets = Whether::yes;
  scenario.wireless.lost_packets = {12};
  EXPECT_EQ(completion_us(scenario), std::nullopt);
  rules(scenario).initial_acknack_arms = Whether::yes;
  EXPECT_EQ(completion_us(scenario), 1'075'110);
}

Scenario issue_6401() {
  Scenario scenario = as_fastdds(base(3));
  is_stale(scenario, 0, 1);
  is_stale(scenario, 1, 2);
  is_stale(scenario, 2, 1);
  rules(scenario).initial_acknack_resets = Whether::yes;
  rules(scenario).initial_acknack_arms = Whether::yes;
  scenario.dds.sedp.piggyback = Piggyback::linear;
  scenario.dds.sedp.piggyback_threshold_bytes = Bytes{400};
  return scenario;
}

TEST(Amended, AHeartbeatAtTheWrongMomentCancelsRecovery) {  // E3
  Scenario scenario = issue_6401();
  EXPECT_EQ(completion_us(scenario), std::nullopt);
  Scenario complete = scenario;
  rules(complete).initial_acknack_stop = InitialAckNackStop::complete;
  EXPECT_EQ(completion_us(complete), 75'110);
  rules(scenario).acked_request = AckedRequest::reopen;
  EXPECT_EQ(completion_us(scenario), 6'220);
}

TEST(Amended, AnExpiryWhileARepairIsUnderWayEndsTheTimer) {  // E4
  Scenario scenario = each_side(base(2));
  SedpProfile& sedp = scenario.dds.sedp;
  sedp.initial_acknack = InitialAckNackReply::heartbeat;
  sedp.heartbeat_period = Nanoseconds{50 * ms};
  sedp.nack_response_delay = Nanoseconds{100 * ms};
  sedp.nack_suppression_duration = Nanoseconds{10 * ms};
  sedp.heartbeat_response_delay = Nanoseconds{10 * ms};
  rules(scenario).heartbeat_condition = HeartbeatCondition::in_u;
  rules(scenario).suppression_end_arms = Whether::no;
  scenario.wireless.lost_packets = {13};
  EXPECT_EQ(completion_us(scenario), std::nullopt);
  rules(scenario).suppression_end_arms = Whether::yes;
  EXPECT_EQ(completion_us(scenario), 286'000);
  rules(scenario).heartbeat_condition = HeartbeatCondition::not_acknowledged;
  scenario.wireless.lost_packets = {21};  // the same DATA: HEARTBEATs have gone before
  EXPECT_EQ(completion_us(scenario), 264'000);
}

TEST(Amended, AReaderKeepsAsking) {  // E8
  Scenario scenario = as_fastdds(base(2));
  is_stale(scenario, 0, 1);
  SedpProfile& sedp = scenario.dds.sedp;
  sedp.nack_response_delay = sedp.heartbeat_response_delay = {};
  sedp.initial_acknack_delay = Nanoseconds{10 * ms};
  rules(scenario).acked_request = AckedRequest::resend;
  rules(scenario).repair_heartbeat = RepairHeartbeat::after;
  rules(scenario).reader_nack_delay = Nanoseconds{100 * ms};
  scenario.wireless.lost_packets = {14, 15};
  EXPECT_EQ(completion_us(scenario), std::nullopt);
  rules(scenario).reader_retry = ReaderRetry::after_nack;
  EXPECT_EQ(completion_us(scenario), 3'015'000);
}

TEST(Amended, ALostReplyToANewcomerIsSentAgain) {  // E10
  Scenario scenario = each_side(base(2));
  scenario.dds.sedp.initial_acknack = InitialAckNackReply::heartbeat;
  scenario.deployment.participants[1].start = Nanoseconds{2 * sec};
  scenario.dds.spdp.period = Nanoseconds{30 * sec};
  scenario.time_limit = Nanoseconds{60 * sec};
  scenario.wireless.lost_packets = {2};
  EXPECT_EQ(completion_us(scenario), 30'004'110);
  rules(scenario).resend_copies = 4;
  EXPECT_EQ(completion_us(scenario), 3'076'110);
}

/// 2 is dead when 1 joins.
Scenario with_a_dead_reader() {
  Scenario scenario = each_side(base(3));
  scenario.deployment.life.emplace();
  scenario.deployment.life->mute.push_back({2, Nanoseconds{ms / 2}});
  scenario.deployment.participants[1].start = Nanoseconds{20'300 * ms};
  scenario.run_until = RunUntil::time_limit;
  scenario.time_limit = Nanoseconds{40 * sec};
  return scenario;
}
/// How long after its start 1 is sent what it lacks if its first request is lost, 10 ms.
std::int64_t repaired_after(Scenario scenario) {
  const std::vector<Sent> requests = run_and_log(scenario).of(PacketKind::acknack, 1, 0);
  if (requests.empty()) return -1;
  scenario.wireless.lost_packets = {requests[0].number};
  const std::vector<std::int64_t> data = run_and_log(scenario).times_of(PacketKind::data, 0, 1);
  return data.empty() ? -1 : (data[0] - 20'300 * ms) / (10 * ms);
}

TEST(Amended, ADeadReaderSlowsEverybodyDown) {  // E11
  Scenario scenario = with_a_dead_reader();
  EXPECT_EQ(repaired_after(scenario), 70);
  rules(scenario).heartbeat_policy = AmendedPolicy::measured_ack;
  EXPECT_EQ(repaired_after(scenario), 570);
  EXPECT_EQ(run_and_log(scenario).times_of(PacketKind::heartbeat, 0, 2),
            (std::vector{1 * ms, 1'001 * ms, 2'001 * ms, 4'001 * ms, 8'001 * ms, 16'001 * ms,
                         26'001 * ms, 36'001 * ms}));
  rules(scenario).heartbeat_policy = AmendedPolicy::of_the_profile;
  scenario.dds.sedp.heartbeat_policy = HeartbeatPolicy::adaptive;
  EXPECT_EQ(repaired_after(scenario), 170);
}

/// Whoever answers ends the wait: with a round trip of 20 ms and one answer after another the
/// HEARTBEATs follow each other by what was measured.
TEST(Amended, APeriodIsMeasuredByTheLastAnswer) {
  Scenario scenario = each_side(base(2, 10 * ms));
  scenario.dds.sedp.heartbeat_period = Nanoseconds{100 * ms};
  scenario.dds.sedp.nack_response_delay = Nanoseconds{150 * ms};
  rules(scenario).heartbeat_policy = AmendedPolicy::measured_ack;
  const std::int64_t round = 20 * ms + scenario.dds.sedp.heartbeat_response_delay.count();
  const std::vector<std::int64_t> times =
      run_and_log(scenario).times_of(PacketKind::heartbeat, 0, 1);
  ASSERT_GE(times.size(), 4U);
  EXPECT_EQ(times[0], 10 * ms);
  EXPECT_EQ(times[1], 110 * ms);  // after the period that the opening has set
  EXPECT_EQ(times[2], times[1] + round);
  EXPECT_EQ(times[3], times[2] + round);
  // The answer to the HEARTBEAT that is lost: the next one is due after 11/10 of the round.
  scenario.wireless.lost_packets = {
      run_and_log(scenario).of(PacketKind::heartbeat, 0, 1)[2].number};
  EXPECT_EQ(run_and_log(scenario).times_of(PacketKind::heartbeat, 0, 1)[3],
            times[2] + round * 11 / 10);
}

TEST(Amended, AnAckNackMayAnswerAnOldHeartbeat) {  // E12
  Scenario scenario = each_side(base(2, 60 * ms));
  SedpProfile& sedp = scenario.dds.sedp;
  sedp.heartbeat_period = Nanoseconds{100 * ms};
  sedp.nack_response_delay = Nanoseconds{10 * ms};
  scenario.run_until = RunUntil::time_limit;
  const auto repairs = [&](StaleAckNack rule) -> std::optional<std::uint64_t> {
    rules(scenario).stale_acknack = rule;
    const RunLog log = run_and_log(scenario);
    if (!log.result.discovery_time) return std::nullopt;
    return log.of(PacketKind::data, 0, 1).size() + log.of(PacketKind::data, 1, 0).size() - 2;
  };
  EXPECT_EQ(repairs(StaleAckNack::process), 2U);
  EXPECT_EQ(repairs(StaleAckNack::latest_only), std::nullopt);
  EXPECT_EQ(repairs(StaleAckNack::required_drop), 2U);
  EXPECT_EQ(repairs(StaleAckNack::required_gate), 2U);
  rules(scenario).repair_heartbeat = RepairHeartbeat::after;
  EXPECT_EQ(repairs(StaleAckNack::required_at_repair), 0U);
}

TEST(Amended, AnAnswerToEachAckNackNeverEnds) {  // E14
  Scenario scenario = each_side(base(2));
  scenario.dds.sedp.nack_response_delay = Nanoseconds{100 * ms};
  scenario.time_limit = Nanoseconds{150 * ms};
  scenario.run_until = RunUntil::time_limit;
  rules(scenario).acknack_reply = AckNackReply::nonfinal;
  const RunResult nonfinal = simulate(scenario);
  EXPECT_EQ(nonfinal.counts.heartbeat, 106U);
  EXPECT_EQ(nonfinal.counts.acknack, 106U);
  rules(scenario).acknack_reply = AckNackReply::none;
  const RunResult none = simulate(scenario);
  EXPECT_EQ(none.counts.heartbeat, 4U);
  EXPECT_EQ(none.counts.acknack, 4U);
}

TEST(Amended, AReaderAcknowledgesWhatItLacks) {  // E15
  Scenario scenario = base(2);
  SedpProfile& sedp = scenario.dds.sedp;
  sedp.relation_opening = RelationOpening::each_side;
  sedp.initial_acknack = InitialAckNackReply::heartbeat;
  sedp.grouping = Grouping::single;
  scenario.dds.descriptors.default_publications = 2;
  scenario.dds.spdp.startup_announcements = 1;
  scenario.dds.spdp.startup_period = Nanoseconds{10 * ms};
  scenario.wireless.lost_packets = {8, 10};
  rules(scenario).on_reannounce = OnReannounce::ack_highest;
  EXPECT_EQ(completion_us(scenario), std::nullopt);
  rules(scenario).on_reannounce = OnReannounce::ack_missing;
  EXPECT_EQ(completion_us(scenario), 13'100);
  rules(scenario).on_reannounce = OnReannounce::none;
  EXPECT_EQ(completion_us(scenario), 75'110);
}

TEST(Amended, CountersOfADeadReaderDelayItsSuccessor) {  // E17
  Scenario scenario = forgotten();
  rules(scenario).initial_acknack_resets = Whether::yes;
  const std::pair<std::uint32_t, double> expected[] = {
      {0, 75'110}, {1, 215'110}, {3, 1'055'110}, {6, 8'895'110}};
  for (const auto& [count, completion] : expected) {
    rules(scenario).count_filter = count;
    EXPECT_EQ(completion_us(scenario), completion) << count;
  }
}

TEST(Amended, WhoIsSilentIsNotHeardAndDoesNothing) {
  Scenario scenario = each_side(base(2));
  scenario.deployment.life.emplace();
  scenario.deployment.life->mute.push_back({1, Nanoseconds{ms / 2}});
  const RunLog log = run_and_log(scenario);
  EXPECT_FALSE(log.result.discovery_time);
  for (const Sent& packet : log.sent) EXPECT_FALSE(packet.source == 1 && packet.time_ns > 0);
}

TEST(Amended, AnOutageHasOneDirection) {
  Scenario scenario = each_side(base(2));
  const auto usual = completion_us(scenario);
  ASSERT_TRUE(usual);
  scenario.deployment.life.emplace();
  scenario.deployment.life->outages.push_back({0, 1, {}, Nanoseconds{5 * sec}});
  const auto later = completion_us(scenario);
  ASSERT_TRUE(later);
  EXPECT_GT(*later, 5'000'000);
}

}  // namespace amended_test
}  // namespace stormproof::model
