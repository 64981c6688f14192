// What the explorer finds about correct rules: known breaches with their shortest paths, known
// thresholds to the nanosecond, and verdicts that name their scope.
#include <algorithm>
#include <array>

#include <fmt/core.h>
#include <gtest/gtest.h>

#include "checker/engines/explorer/explorer.hpp"
#include "checker/engines/explorer/plan.hpp"
#include "checker/engines/explorer/relation_world.hpp"
#include "checker/engines/explorer/replay.hpp"
#include "tests/checker/engines/explorer/tiny.hpp"

namespace stormproof::explorer {
namespace finding_test {

using model::Nanoseconds;
using props::Finding;
using props::VerdictKind;

/// The paper's timers on a network with delays up to this one. One packet is faster, so the
/// explorer takes every delay up to the largest.
model::Scenario wired(std::int64_t delay_ns) {
  model::Scenario scenario;
  scenario.deployment = model::Deployment::homogeneous(2, 1, 2);
  scenario.wireless.kind = model::ServiceKind::constant_delay;
  scenario.wireless.one_way = Nanoseconds{delay_ns};
  scenario.wireless.packet_delays = {{0, Nanoseconds{0}, Nanoseconds{delay_ns / 2}}};
  return scenario;
}

Finding find(const model::Scenario& scenario, std::string_view property) {
  const std::array ids{property};
  checker::Findings findings = explore(ids, {scenario, nullptr, {}});
  EXPECT_EQ(findings.size(), 1U);
  return findings.at(0).second;
}

SearchResult search_paper(const model::Scenario& scenario, const Scope& scope, Claim claim) {
  RelationWorld world{scenario, scenario, scope, {}};
  SearchOptions options;
  options.claims = bit(claim);
  return Search<RelationWorld>{world, options}.run();
}

TEST(Explorer, AConstantDelayLetsNothingOvertake) {
  model::Scenario scenario = wired(100'000);
  EXPECT_EQ(find(scenario, "storm.single-copy").kind, VerdictKind::violated);
  scenario.wireless.packet_delays.clear();
  const Finding finding = find(scenario, "storm.single-copy");
  EXPECT_EQ(finding.kind, VerdictKind::bounded) << finding.how;
  EXPECT_NE(finding.how.find("100 µs"), std::string::npos) << finding.how;
}

TEST(Explorer, HoldsWhatTheTablesProve) {
  const model::Scenario scenario = wired(100'000);
  for (const char* id : {"safety.ack-implies-received", "safety.repair-only-if-asked",
                         "safety.snapshot", "timer.single-heartbeat", "live.no-stall",
                         "timer.suppression-honoured", "live.completion"}) {
    const Finding finding = find(scenario, id);
    EXPECT_EQ(finding.kind, VerdictKind::bounded) << id << ": " << finding.how;
    EXPECT_NE(finding.how.find("zone states"), std::string::npos);
    EXPECT_NE(finding.how.find("D = 2, k = 1"), std::string::npos) << "the scope is stated";
    EXPECT_FALSE(finding.details.empty());
  }
}

TEST(Explorer, AdditiveTimersHaveTwoExpiriesPending) {
  model::Scenario scenario = wired(100'000);
  scenario.dds.sedp.heartbeat_timer = model::HeartbeatTimerKind::additive;
  const Finding finding = find(scenario, "timer.single-heartbeat");
  ASSERT_EQ(finding.kind, VerdictKind::violated) << finding.how;
  ASSERT_TRUE(finding.counterexample);
  EXPECT_FALSE(finding.counterexample->steps.empty());
  EXPECT_EQ(finding.counterexample->scenario.deployment.size(), 2U);
}

TEST(Explorer, ARepairBatchThatSpansPacketsEndsItsSuppressionEarly) {
  model::Scenario scenario = wired(100'000);
  scenario.dds.sedp.grouping = model::Grouping::single;
  const Finding finding = find(scenario, "timer.suppression-honoured");
  ASSERT_EQ(finding.kind, VerdictKind::violated) << finding.how;
  EXPECT_NE(finding.counterexample->reason.find("suppression"), std::string::npos);
}

TEST(Explorer, ARepairIsPossibleOnlyIfDataTakeLongerThanTheResponseDelay) {
  model::Scenario scenario = tiny_scenario();
  Scope scope;
  scope.least_delay = Nanoseconds{0};
  for (const std::int64_t response : {1, 3}) {
    scenario.dds.sedp.heartbeat_response_delay = Nanoseconds{response};
    scope.largest_delay = Nanoseconds{response};
    SearchResult result = search_paper(scenario, scope, Claim::free_threshold);
    EXPECT_TRUE(result.exhausted());
    EXPECT_FALSE(result.objections[static_cast<std::size_t>(Claim::free_threshold)]);
    scope.largest_delay = Nanoseconds{response + 1};
    result = search_paper(scenario, scope, Claim::free_threshold);
    EXPECT_TRUE(result.objections[static_cast<std::size_t>(Claim::free_threshold)]);
  }
}

TEST(Explorer, NoRepairIsPossibleAsLongAsNothingOvertakesData) {
  const model::Scenario scenario = tiny_scenario();
  Scope scope;
  scope.least_delay = Nanoseconds{1};
  scope.largest_delay = Nanoseconds{5};
  scope.fifo = true;
  SearchResult result = search_paper(scenario, scope, Claim::free_threshold);
  EXPECT_TRUE(result.exhausted());
  EXPECT_FALSE(result.objections[static_cast<std::size_t>(Claim::free_threshold)]);
  scope.fifo = false;
  result = search_paper(scenario, scope, Claim::free_threshold);
  EXPECT_TRUE(result.objections[static_cast<std::size_t>(Claim::free_threshold)]);
}

TEST(Explorer, InitialAckNacksCanGoOnForever) {
  // The only HEARTBEAT is lost, and initial ACKNACKs acknowledge everything: nobody sends another.
  const Finding finding = find(wired(100'000), "live.quiescence");
  ASSERT_EQ(finding.kind, VerdictKind::violated) << finding.how;
  EXPECT_EQ(finding.counterexample->scenario.wireless.lost_packets.size(), 1U);
}

TEST(Explorer, InitialAckNacksOfAConstantIntervalDoToo) {
  model::Scenario scenario = wired(100'000);
  const std::string doubles = "The delay between initial ACKNACKs doubles six times.";
  EXPECT_TRUE(std::ranges::count(find(scenario, "live.quiescence").assumptions, doubles));
  scenario.dds.sedp.initial_acknack_interval = model::InitialAckNackInterval::constant;
  const Finding finding = find(scenario, "live.quiescence");
  ASSERT_EQ(finding.kind, VerdictKind::violated) << finding.how;
  EXPECT_FALSE(std::ranges::count(finding.assumptions, doubles));  // nothing is cut off
}

TEST(Explorer, CompletionBoundIsAttainedButNotExceeded) {
  model::Scenario scenario = tiny_scenario();
  Scope scope;
  scope.losses = 2;
  scope.least_delay = Nanoseconds{1};
  scope.largest_delay = Nanoseconds{2};
  scope.leaves_within = scope.largest_delay;
  const auto bound = completion_bound(scenario.dds, scope);
  ASSERT_TRUE(bound);
  RelationWorld world{scenario, scenario, scope, {}};
  SearchOptions options;
  options.claims = bit(Claim::completion);
  options.stop_when_complete = true;
  options.bounds.completion = bound;
  SearchResult result = Search<RelationWorld>{world, options}.run();
  EXPECT_TRUE(result.exhausted());
  EXPECT_FALSE(result.objections[static_cast<std::size_t>(Claim::completion)]);
  EXPECT_EQ(result.latest_completion, *bound);

  options.bounds.completion = *bound - Nanoseconds{1};
  result = Search<RelationWorld>{world, options}.run();
  const auto& path = result.objections[static_cast<std::size_t>(Claim::completion)];
  ASSERT_TRUE(path);
  const auto concrete = concrete_path(world, *path, Claim::completion, options.bounds);
  ASSERT_TRUE(concrete);
  const ReplayOutcome outcome =
      replay({scenario, scenario, nullptr, scope, options.bounds}, *concrete, "live.completion");
  EXPECT_TRUE(outcome.counterexample) << outcome.why_not;
}

TEST(Explorer, FastDdsEndsTheSuppressionOfALaterDescriptorEarly) {
  model::Scenario scenario = wired(100'000);
  scenario.dds.implementation = model::ImplementationKind::fastdds;
  const Finding finding = find(scenario, "timer.suppression-honoured");
  ASSERT_EQ(finding.kind, VerdictKind::violated) << finding.how;
}

TEST(Explorer, FastDdsKeepsWhatTheTablesProve) {
  model::Scenario scenario = wired(1'000);
  scenario.dds.implementation = model::ImplementationKind::fastdds;
  const std::array<std::string_view, 4> ids{"safety.ack-implies-received",
                                            "safety.repair-only-if-asked", "timer.single-heartbeat",
                                            "live.no-stall"};
  for (const auto& [id, finding] : explore(ids, {scenario, nullptr, {}})) {
    EXPECT_EQ(finding.kind, VerdictKind::bounded) << id << ": " << finding.how;
  }
}

TEST(Explorer, SaysWhatItCannotExplore) {
  model::Scenario scenario = wired(100'000);
  scenario.dds.sedp.heartbeat_policy = model::HeartbeatPolicy::adaptive;
  const Finding finding = find(scenario, "live.no-stall");
  EXPECT_EQ(finding.kind, VerdictKind::inconclusive);
  EXPECT_NE(finding.how.find("adaptive"), std::string::npos);

  const std::array<std::string_view, 2> others{"fsm.determinism", "safety.conservation"};
  EXPECT_TRUE(explore(others, {scenario, nullptr, {}}).empty());
}

TEST(Explorer, AnUnfinishedSearchSaysHowFarItCame) {
  model::Scenario scenario = wired(100'000);
  Scope scope;
  scope.losses = 1;
  scope.largest_delay = Nanoseconds{250'000'000};
  RelationWorld world{scenario, scenario, scope, {}};
  SearchOptions options;
  options.claims = bit(Claim::no_stall);
  options.max_states = 2'000;
  SearchResult result = Search<RelationWorld>{world, options}.run();
  EXPECT_EQ(result.cut_short, CutShort::by_limit);
  EXPECT_GT(result.depth, 2U);
  EXPECT_LT(result.depth, 50U);

  options.max_states = 1'000'000;
  options.go_on = [] { return false; };
  result = Search<RelationWorld>{world, options}.run();
  EXPECT_EQ(result.cut_short, CutShort::by_interruption);
}

TEST(Explorer, WhatDoesNotFitIntoAStateIsNotOverlooked) {
  // Hundreds of HEARTBEATs are under way when the first one arrives.
  model::Scenario scenario = wired(100'000'000);
  scenario.wireless.packet_delays.clear();
  scenario.dds.sedp.heartbeat_period = Nanoseconds{1'000'000};
  scenario.dds.sedp.initial_data = model::InitialData::pull;
  Scope scope;
  scope.least_delay = scope.largest_delay = scenario.wireless.one_way;
  RelationWorld world{scenario, scenario, scope, {}};
  SearchOptions options;
  options.claims = bit(Claim::no_stall);
  const SearchResult result = Search<RelationWorld>{world, options}.run();
  EXPECT_EQ(result.cut_short, CutShort::by_overflow);
  // Every step before has been taken, and there are no more.
  EXPECT_EQ(result.states, result.depth + 1);
  const Finding finding = find(scenario, "live.no-stall");
  EXPECT_EQ(finding.kind, VerdictKind::inconclusive) << finding.how;
  EXPECT_NE(finding.how.find(fmt::format("all paths of up to {} events", result.depth)),
            std::string::npos)
      << finding.how;
}

TEST(Explorer, ASearchThatIsCutShortIsNoVerdict) {
  const model::Scenario scenario = wired(250'000'000);  // thousands of states
  const std::array<std::string_view, 1> ids{"live.no-stall"};
  const auto stop = [](std::string_view what) { return !what.starts_with("exploring"); };
  const Finding finding = explore(ids, {scenario, nullptr, stop}).at(0).second;
  EXPECT_EQ(finding.kind, VerdictKind::inconclusive);
  EXPECT_EQ(finding.how, "interrupted");
}

TEST(Explorer, GivesTheSameAnswerTwice) {
  const model::Scenario scenario = wired(100'000);
  const Finding first = find(scenario, "timer.suppression-honoured");
  const Finding second = find(scenario, "timer.suppression-honoured");
  EXPECT_EQ(first.how, second.how);
  EXPECT_EQ(first.details, second.details);
}

TEST(Explorer, DescriptorsAreSplitOverPacketsAsInTheScenario) {
  model::Scenario scenario = wired(100'000);
  EXPECT_EQ(splitting(scenario).in_scenario, 1U);
  scenario.dds.sedp.grouping = model::Grouping::mtu;
  scenario.dds.descriptors.user_bytes = model::Bytes{300};
  // 36 bytes are shared, 5 of 264 bytes fit beside them.
  EXPECT_GT(splitting(scenario).in_scenario, 1U);
  EXPECT_EQ(splitting(scenario).descriptors, 6U);
  const Finding finding = find(scenario, "timer.suppression-honoured");
  ASSERT_EQ(finding.kind, VerdictKind::violated) << finding.how;
  EXPECT_EQ(finding.counterexample->scenario.deployment.participants[0].publications, 6U);

  // Nothing is split where there is one descriptor.
  scenario.dds.descriptors.default_publications = 0;
  scenario.dds.descriptors.default_subscriptions = 0;
  scenario.dds.sedp.grouping = model::Grouping::single;
  for (model::Participant& participant : scenario.deployment.participants) {
    participant.publications = 1;
    participant.subscriptions = 0;
  }
  EXPECT_EQ(splitting(scenario).in_scenario, 1U);
  EXPECT_EQ(find(scenario, "timer.suppression-honoured").kind, VerdictKind::bounded);

  // So many share a packet that the explored relation has not enough.
  scenario.dds.sedp.grouping = model::Grouping::message;
  for (model::Participant& participant : scenario.deployment.participants) {
    participant.publications = 1'000;
  }
  EXPECT_TRUE(splitting(scenario).cannot_follow());
  const Finding unlike = find(scenario, "timer.suppression-honoured");
  EXPECT_TRUE(std::ranges::any_of(unlike.assumptions, [](const std::string& assumption) {
    return assumption.find("largest relation takes") != std::string::npos;
  }));
}

TEST(Explorer, FastDdssDescriptorsAreSplitOverMessages) {
  model::Scenario scenario = wired(100'000);
  scenario.dds.implementation = model::ImplementationKind::fastdds;
  EXPECT_EQ(splitting(scenario).in_scenario, 1U);
  scenario.dds.sedp.grouping_limit_bytes = model::Bytes{1'456};
  EXPECT_GT(splitting(scenario).in_scenario, 2U);
  EXPECT_FALSE(splitting(scenario).cannot_follow());
}

}  // namespace finding_test
}  // namespace stormproof::explorer
