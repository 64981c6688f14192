// The verdicts about scenarios.
#include <algorithm>

#include <gtest/gtest.h>

#include "checker/engines/timeline/directed_check.hpp"
#include "tests/checker/engines/timeline/requests.hpp"

namespace stormproof::timeline {
namespace check_test {

using model::Nanoseconds;
using props::VerdictKind;

bool mentions(const std::vector<std::string>& lines, std::string_view text) {
  return std::ranges::any_of(
      lines, [&](const std::string& line) { return line.find(text) != std::string::npos; });
}

/// The monitor objects to the counterexample's run at the event that it names.
void expect_confirmed(const props::Finding& finding) {
  ASSERT_TRUE(finding.counterexample);
  const auto again =
      confirmed_counterexample(finding.counterexample->property, finding.counterexample->scenario);
  ASSERT_TRUE(again);
  EXPECT_EQ(again->event, finding.counterexample->event);
  EXPECT_EQ(again->time, finding.counterexample->time);
}

TEST(TimelineCheck, CompletionIsProvedWithNumbers) {
  const props::Finding finding = finding_about("live.completion", quiet_scenario());
  EXPECT_EQ(finding.kind, VerdictKind::proved) << finding.how;
  EXPECT_EQ(finding.engine, "timelines");
  EXPECT_TRUE(mentions(finding.details, "B(0) = 1 ms, B(1) = 3.11 ms, B(2) = 1.00311 s"));
  EXPECT_TRUE(mentions(finding.details, "24 of 24 boundary runs"));
  EXPECT_TRUE(mentions(finding.assumptions, "the largest delay is 1 ms"));
}

TEST(TimelineCheck, ConstantDelayBelowTheInitialAckNackIsFreeOfStorms) {
  for (const char* property : {"storm.free-threshold", "storm.single-copy"}) {
    const props::Finding finding = finding_about(property, quiet_scenario());
    EXPECT_EQ(finding.kind, VerdictKind::proved) << finding.how;
    EXPECT_TRUE(mentions(finding.details, "= 70.09 ms; largest measured 1 ms, margin 69.09 ms"));
  }
}

/// Whoever takes the assumptions at their word gets what is promised: a delay above Δ* breaks one.
TEST(TimelineCheck, WhatIsProvedUpToAThresholdAssumesIt) {
  model::Scenario apart = quiet_scenario();
  apart.wireless.packet_delays = {{0, Nanoseconds{0}, Nanoseconds{5'000}}};
  apart.wireless.one_way = Nanoseconds{5'000};
  for (const char* property : {"storm.free-threshold", "storm.single-copy"}) {
    const props::Finding constant = finding_about(property, quiet_scenario());
    EXPECT_TRUE(mentions(constant.assumptions, "no packet takes longer than Δ* = ")) << property;
    EXPECT_TRUE(mentions(constant.assumptions, " = 70.09 ms")) << property;
    const props::Finding any = finding_about(property, apart);
    EXPECT_EQ(any.kind, VerdictKind::proved) << any.how;
    EXPECT_TRUE(mentions(any.assumptions, "no packet takes longer than Δ* = min(τ_A, τ_I) = 10"));
  }
}

TEST(TimelineCheck, ConstantDelayAboveTheInitialAckNackIsNot) {
  model::Scenario scenario = quiet_scenario();
  scenario.wireless.one_way = Nanoseconds{70'090'000};
  EXPECT_EQ(finding_about("storm.free-threshold", scenario).kind, VerdictKind::proved);
  scenario.wireless.one_way = Nanoseconds{70'090'001};
  for (const char* property : {"storm.free-threshold", "storm.single-copy"}) {
    const props::Finding finding = finding_about(property, scenario);
    EXPECT_EQ(finding.kind, VerdictKind::violated) << finding.how;
    expect_confirmed(finding);
  }
}

TEST(TimelineCheck, ASharedChannelExceedsTheThreshold) {
  model::Scenario scenario = quiet_scenario();
  scenario.wireless = {};
  for (const char* property : {"storm.free-threshold", "storm.single-copy"}) {
    const props::Finding finding = finding_about(property, scenario);
    EXPECT_EQ(finding.kind, VerdictKind::violated) << finding.how;
    expect_confirmed(finding);
  }
}

TEST(TimelineCheck, PulledDataIsRequestedTwice) {
  for (const auto reply :
       {model::InitialAckNackReply::bitmap, model::InitialAckNackReply::heartbeat,
        model::InitialAckNackReply::none}) {
    model::Scenario scenario = quiet_scenario();
    scenario.wireless.one_way = Nanoseconds{2'000'000'000};
    scenario.wireless.packet_delays = {{0, Nanoseconds{0}, Nanoseconds{1'000'000'000}}};
    scenario.dds.sedp.initial_data = model::InitialData::pull;
    scenario.dds.sedp.initial_acknack = reply;
    const props::Finding finding = finding_about("storm.free-threshold", scenario);
    EXPECT_EQ(finding.kind, VerdictKind::violated) << finding.how;
    expect_confirmed(finding);
  }
}

TEST(TimelineCheck, FastDdsOnASharedChannelExceedsTheThreshold) {
  model::Scenario scenario = quiet_scenario();
  scenario.dds.implementation = model::ImplementationKind::fastdds;
  scenario.wireless = {};
  const props::Finding completion = finding_about("live.completion", scenario);
  EXPECT_EQ(completion.kind, VerdictKind::proved) << completion.how;
  EXPECT_TRUE(mentions(completion.details, "32 of 32 runs"));
  const props::Finding threshold = finding_about("storm.free-threshold", scenario);
  EXPECT_EQ(threshold.kind, VerdictKind::violated) << threshold.how;
  expect_confirmed(threshold);
  EXPECT_EQ(finding_about("live.quiescence", scenario).kind, VerdictKind::inconclusive);
}

TEST(TimelineCheck, InitialAckNacksThatConfirmNeverEnd) {
  model::Scenario scenario = quiet_scenario();
  const props::Finding endless = finding_about("live.quiescence", scenario);
  EXPECT_EQ(endless.kind, VerdictKind::violated) << endless.how;
  expect_confirmed(endless);
  scenario.dds.sedp.initial_acknack = model::InitialAckNackReply::heartbeat;
  const props::Finding quiet = finding_about("live.quiescence", scenario);
  EXPECT_EQ(quiet.kind, VerdictKind::proved) << quiet.how;
  EXPECT_TRUE(mentions(quiet.details, "1 of 1 boundary runs"));
}

TEST(TimelineCheck, TheIntervalOfInitialAckNacksChangesNoVerdict) {
  for (const auto reply :
       {model::InitialAckNackReply::bitmap, model::InitialAckNackReply::heartbeat}) {
    model::Scenario scenario = quiet_scenario();
    scenario.dds.sedp.initial_acknack = reply;
    model::Scenario constant = scenario;
    constant.dds.sedp.initial_acknack_interval = model::InitialAckNackInterval::constant;
    for (const char* property : {"live.completion", "live.quiescence", "storm.free-threshold"}) {
      const props::Finding finding = finding_about(property, constant);
      EXPECT_EQ(finding.kind, finding_about(property, scenario).kind) << property << finding.how;
      if (finding.kind == VerdictKind::violated) expect_confirmed(finding);
      EXPECT_FALSE(mentions(finding.details, "doubling")) << property;
    }
  }
}

TEST(TimelineCheck, AdaptivePeriodsHaveNoBoundHere) {
  model::Scenario scenario = quiet_scenario();
  scenario.dds.sedp.heartbeat_policy = model::HeartbeatPolicy::adaptive;
  EXPECT_EQ(finding_about("live.completion", scenario).kind, VerdictKind::inconclusive);
  EXPECT_EQ(finding_about("live.quiescence", scenario).kind, VerdictKind::inconclusive);
}

TEST(TimelineCheck, IsSilentAboutOtherProperties) {
  smt::Claims claims{z3_only()};
  const model::Scenario scenario = quiet_scenario();
  const checker::CheckRequest request{scenario, claims, nullptr, 0, 12, {}};
  const std::string_view ids[] = {"fsm.determinism"};
  EXPECT_TRUE(check(ids, request).empty());
}

}  // namespace check_test
}  // namespace stormproof::timeline
