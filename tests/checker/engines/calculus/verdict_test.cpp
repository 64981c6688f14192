// The verdict about a deployment: proved, missed and by how much, and how it depends on the
// profile.
#include <algorithm>

#include <gtest/gtest.h>

#include "checker/engines/calculus/calculus.hpp"
#include "checker/engines/calculus/cannot_start.hpp"
#include "props/monitors/describe.hpp"
#include "tests/checker/engines/timeline/requests.hpp"

namespace stormproof::calculus {
namespace verdict_test {

using model::Nanoseconds;
using props::VerdictKind;

constexpr Nanoseconds second{1'000'000'000};

/// Two hosts with a participant each, on Wi-Fi, with readers that wait for a second.
model::Scenario patient_scenario() {
  model::Scenario scenario;
  scenario.deployment = model::Deployment::homogeneous(2, 1, 2);
  scenario.dds.sedp.heartbeat_response_delay = second;
  scenario.dds.sedp.initial_acknack_delay = second;
  return scenario;
}

props::Finding finding_about(const model::Scenario& scenario,
                             const checker::Mutant* mutant = nullptr) {
  return timeline::finding_by(check, cannot_start, scenario, mutant);
}

TEST(CannotStart, IsProvedFromTheDeploymentAlone) {
  const props::Finding finding = finding_about(patient_scenario());
  EXPECT_EQ(finding.kind, VerdictKind::proved) << finding.how;
  EXPECT_EQ(finding.engine, "network calculus");
  EXPECT_NE(finding.how.find("open-loop packets take at most 19.69"), std::string::npos)
      << finding.how;
}

bool says(const std::vector<std::string>& lines, std::string_view text) {
  return std::ranges::any_of(
      lines, [&](const std::string& line) { return line.find(text) != std::string::npos; });
}

/// A scenario that loses packets has no run of which it is true.
TEST(CannotStart, SaysThatItIsAboutNoRunThatLosesSomething) {
  model::Scenario scenario = patient_scenario();
  EXPECT_FALSE(says(finding_about(scenario).assumptions, "lost_packets"));
  scenario.wireless.lost_packets = {4, 5, 6, 7};
  const props::Finding finding = finding_about(scenario);
  EXPECT_EQ(finding.kind, VerdictKind::proved);
  EXPECT_TRUE(says(finding.assumptions,
                   "nothing is said of the scenario's own run, which is to "
                   "lose 4 (wireless.lost_packets)"));
  for (const char* property : {"live.completion", "live.quiescence"}) {
    const props::Finding closed = timeline::finding_by(check, property, scenario);
    if (closed.assumptions.empty()) continue;
    EXPECT_TRUE(says(closed.assumptions, "which is to lose 4")) << property;
  }
}

/// What is said of the longest packet is what the verdict compares.
TEST(CannotStart, ThePacketsOfAHostCountIfTheyTakeLonger) {
  model::Scenario scenario = patient_scenario();
  scenario.dds.implementation = model::ImplementationKind::fastdds;
  scenario.dds.sedp.nack_response_delay = Nanoseconds{1'000'000};
  scenario.deployment.loopback_delay = Nanoseconds{400'000'000};
  ASSERT_GT(*judge(scenario).delay, *judge(scenario).busy);
  const props::Finding finding = finding_about(scenario);
  EXPECT_TRUE(says(finding.details, "takes longer than 400 ms, as long as on the same host"));
  EXPECT_FALSE(
      says(finding.details, "takes longer than " + props::time_text(*judge(scenario).busy)));
}

TEST(CannotStart, OneNanosecondDecides) {
  model::Scenario scenario = patient_scenario();
  const Nanoseconds longest = *judge(scenario).delay;
  scenario.dds.sedp.heartbeat_response_delay = longest;
  EXPECT_EQ(finding_about(scenario).kind, VerdictKind::proved);
  scenario.dds.sedp.heartbeat_response_delay = longest - Nanoseconds{1};
  const props::Finding missed = finding_about(scenario);
  EXPECT_EQ(missed.kind, VerdictKind::inconclusive);
  EXPECT_NE(missed.how.find("missed by 1 ns"), std::string::npos) << missed.how;
}

TEST(CannotStart, EveryLemmaIsProvedByTheSolver) {
  for (const Lemma lemma : {Lemma::any_order, Lemma::in_order, Lemma::constant_delay,
                            Lemma::patient_reader, Lemma::long_suppression}) {
    const props::Finding finding =
        timeline::finding_of([&](timeline::Theorem& theorem) { prove_lemmas(theorem, lemma); });
    EXPECT_EQ(finding.kind, VerdictKind::proved) << static_cast<int>(lemma) << finding.how;
  }
}

TEST(CannotStart, WrongNumbersAreRefuted) {
  const model::Scenario scenario = patient_scenario();
  const Judged judged = judge(scenario);
  for (const std::int64_t less : {0, 1}) {
    const bool proved = timeline::is_proved([&](timeline::Theorem& theorem) {
      prove_numbers(theorem, *judged.traffic, *judged.busy - Nanoseconds{less}, *judged.delay);
    });
    EXPECT_EQ(proved, less == 0);
  }
}

TEST(CannotStart, AChannelThatKeepsTheOrderAllowsMore) {
  model::Scenario scenario = patient_scenario();
  scenario.dds.sedp.heartbeat_response_delay = Nanoseconds{10'000};
  scenario.dds.sedp.piggyback = model::Piggyback::off;
  EXPECT_EQ(judge(scenario).threshold.lemma, Lemma::any_order);
  EXPECT_FALSE(judge(scenario).is_proved());
  scenario.wireless.fragment_request = model::FragmentRequest::at_admission;
  EXPECT_EQ(judge(scenario).threshold.lemma, Lemma::in_order);
  EXPECT_TRUE(judge(scenario).is_proved());
  scenario.dds.sedp.initial_acknack = model::InitialAckNackReply::heartbeat;
  EXPECT_TRUE(judge(scenario).threshold.unlimited);
  scenario.dds.sedp.piggyback = model::Piggyback::linear;
  scenario.dds.sedp.piggyback_threshold_bytes = model::Bytes{500};
  EXPECT_EQ(judge(scenario).threshold.lemma, Lemma::any_order);
}

TEST(CannotStart, SaysWhatItDoesNotCover) {
  model::Scenario scenario = patient_scenario();
  scenario.dds.sedp.heartbeat_policy = model::HeartbeatPolicy::adaptive;
  EXPECT_NE(finding_about(scenario).how.find("adaptive"), std::string::npos);
  scenario = patient_scenario();
  scenario.dds.sedp.relation_opening = model::RelationOpening::each_side;
  EXPECT_EQ(finding_about(scenario).kind, VerdictKind::inconclusive);
  scenario = patient_scenario();
  scenario.dds.sedp.heartbeat_period = Nanoseconds{1'000};  // more than the channel can carry
  const props::Finding busy = finding_about(scenario);
  EXPECT_EQ(busy.kind, VerdictKind::inconclusive);
  EXPECT_NE(busy.how.find("without end"), std::string::npos) << busy.how;
}

TEST(CannotStart, IsSilentAboutMutants) {
  const model::Scenario scenario = patient_scenario();
  const checker::Mutant mutant;
  EXPECT_TRUE(finding_about(scenario, &mutant).engine.empty());
}

}  // namespace verdict_test
}  // namespace stormproof::calculus
