// What the explorer finds about correct rules: known breaches with their shortest paths, known
// thresholds to the nanosecond, and verdicts that name their scope.
#include <algorithm>
#include <array>

#include <gtest/gtest.h>

#include "checker/engines/explorer/explorer.hpp"
#include "checker/engines/explorer/fastdds_packing.hpp"
#include "checker/engines/explorer/paper_packing.hpp"
#include "checker/engines/explorer/plan.hpp"
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
  PaperWorld world{scenario, scenario, scope, {}};
  SearchOptions options;
  options.claims = bit(claim);
  return Search<PaperWorld>{world, options}.run();
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
    EXPECT_TRUE(result.exhausted);
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
  EXPECT_TRUE(result.exhausted);
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
  PaperWorld world{scenario, scenario, scope, {}};
  SearchOptions options;
  options.claims = bit(Claim::completion);
  options.stop_when_complete = true;
  options.bounds.completion = bound;
  SearchResult result = Search<PaperWorld>{world, options}.run();
  EXPECT_TRUE(result.exhausted);
  EXPECT_FALSE(result.objections[static_cast<std::size_t>(Claim::completion)]);
  EXPECT_EQ(result.latest_completion, *bound);

  options.bounds.completion = *bound - Nanoseconds{1};
  result = Search<PaperWorld>{world, options}.run();
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
  PaperWorld world{scenario, scenario, scope, {}};
  SearchOptions options;
  options.claims = bit(Claim::no_stall);
  options.max_states = 2'000;
  SearchResult result = Search<PaperWorld>{world, options}.run();
  EXPECT_FALSE(result.exhausted);
  EXPECT_GT(result.depth, 2U);
  EXPECT_LT(result.depth, 50U);

  options.max_states = 1'000'000;
  options.go_on = [] { return false; };
  result = Search<PaperWorld>{world, options}.run();
  EXPECT_FALSE(result.exhausted);
}

}  // namespace finding_test
}  // namespace stormproof::explorer
