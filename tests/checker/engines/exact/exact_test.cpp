// The verdicts of the exact run: bounded, sampled, violated with a counterexample that repeats, and
// inconclusive when the run does not get far enough.
#include "checker/engines/exact/exact.hpp"

#include <algorithm>

#include <gtest/gtest.h>

#include "checker/engines/smt/claims.hpp"
#include "tests/props/monitored_run.hpp"

namespace stormproof::exact {
namespace exact_test {

using checker::CheckRequest;
using props::Finding;
using props::VerdictKind;

class ExactRun : public testing::Test {
 protected:
  Finding ask(std::string_view property, const model::Scenario& scenario,
              const checker::Mutant* mutant = nullptr) {
    CheckRequest request{scenario, claims_, nullptr, 0, 12, {}};
    request.mutant = mutant;
    request.samples = 3;
    request.seed = 5;
    const std::string_view wanted[] = {property};
    const checker::Findings findings = check(wanted, request);
    if (findings.size() != 1 || findings[0].first != property) {
      ADD_FAILURE() << findings.size() << " findings about " << property;
      return {};
    }
    EXPECT_EQ(findings[0].second.engine, "exact run");
    return findings[0].second;
  }

  smt::Claims claims_;
};

/// The monitor objects to the run of the counterexample, at its event, for its reason.
void expect_repeats(const props::Counterexample& counterexample) {
  const auto run = props::run_monitored(counterexample.scenario);
  const props::Violation* const violation = run.violation(counterexample.property);
  ASSERT_NE(violation, nullptr) << counterexample.property;
  EXPECT_EQ(violation->event, counterexample.event);
  EXPECT_EQ(violation->time, counterexample.time);
  EXPECT_EQ(violation->reason, counterexample.reason);
  EXPECT_FALSE(counterexample.scenario.deployment.schedule);
}

TEST_F(ExactRun, AnswersForEveryMonitoredPropertyAndNoOther) {
  const model::Scenario scenario = props::shipped("smallest");
  std::vector<std::string_view> wanted = props::monitored_properties(scenario);
  wanted.emplace_back("fsm.determinism");
  const checker::Findings findings =
      check(wanted, CheckRequest{scenario, claims_, nullptr, 0, 12, {}});
  EXPECT_EQ(findings.size(), wanted.size() - 1);
  for (const auto& [property, finding] : findings) {
    const bool violated = property == "storm.free-threshold" || property == "storm.cannot-start" ||
                          property == "storm.join-cost";
    EXPECT_EQ(finding.kind, violated ? VerdictKind::violated : VerdictKind::observed) << property;
    EXPECT_FALSE(finding.how.empty());
  }
}

TEST_F(ExactRun, IsBoundedToTheTrajectory) {
  const Finding finding = ask("safety.snapshot", props::shipped("smallest"));
  EXPECT_EQ(finding.kind, VerdictKind::observed);
  EXPECT_EQ(finding.how, "on the one trajectory of this scenario, 126 events, up to 16.136228 ms");
  EXPECT_EQ(finding.details, std::vector<std::string>{"4 ACKNACKs reached their writer as "
                                                      "generated."});
}

TEST_F(ExactRun, GoesOnBeyondCompletionForQuiescence) {
  const Finding finding = ask("live.quiescence", props::shipped("smallest"));
  EXPECT_EQ(finding.kind, VerdictKind::observed);
  ASSERT_EQ(finding.details.size(), 1U) << finding.details[1];
}

TEST_F(ExactRun, ShowsAViolationOnASmallerDeployment) {
  const Finding finding = ask("storm.free-threshold", props::shipped("wifi-5x20"));
  ASSERT_EQ(finding.kind, VerdictKind::violated);
  ASSERT_TRUE(finding.counterexample);
  EXPECT_LT(finding.counterexample->event, 300U);
  EXPECT_EQ(finding.counterexample->scenario.deployment.size(), 2U);
  EXPECT_EQ(finding.details.front().substr(0, 40), "In the scenario itself at event 16489, 1");
  expect_repeats(*finding.counterexample);
}

TEST_F(ExactRun, ShowsEndlessTraffic) {
  const Finding finding =
      ask("live.quiescence",
          props::shipped("smallest",
                         {"dds.sedp.piggyback=off",
                          "wireless={kind: constant_delay, one_way: 1ms, lost_packets: [5]}"}));
  ASSERT_EQ(finding.kind, VerdictKind::violated);
  expect_repeats(*finding.counterexample);
}

TEST_F(ExactRun, SamplesDrawnSchedules) {
  const model::Scenario scenario =
      props::shipped("wifi-5x20-fastdds", {"deployment.participants_per_host=1"});
  const Finding holds = ask("safety.ack-implies-received", scenario);
  EXPECT_EQ(holds.kind, VerdictKind::sampled);
  EXPECT_EQ(holds.how, "3 runs with drawn schedules, seeds 5 to 7");
  EXPECT_EQ(holds.seed, 5U);
}

TEST_F(ExactRun, ShowsTheDrawnScheduleThatViolates) {
  const model::Scenario scenario = props::shipped("wifi-5x20-fastdds");
  const Finding broken = ask("timer.suppression-honoured", scenario);
  ASSERT_EQ(broken.kind, VerdictKind::violated);
  expect_repeats(*broken.counterexample);
}

TEST_F(ExactRun, AnIncompleteRunSaysNothingAboutLiveness) {
  const model::Scenario scenario = props::shipped("smallest", {"time_limit=10ms"});
  EXPECT_EQ(ask("live.completion", scenario).kind, VerdictKind::inconclusive);
  EXPECT_EQ(ask("live.quiescence", scenario).kind, VerdictKind::inconclusive);
  const Finding safety = ask("safety.snapshot", scenario);
  EXPECT_EQ(safety.kind, VerdictKind::observed);
  EXPECT_NE(safety.how.find("up to 10 ms"), std::string::npos);
}

TEST_F(ExactRun, CanBeInterrupted) {
  const model::Scenario scenario = props::shipped("wifi-5x20");
  CheckRequest request{scenario, claims_, nullptr, 0, 12, {}};
  request.on_progress = [](std::string_view) { return false; };
  const std::string_view wanted[] = {"safety.snapshot", "live.quiescence"};
  for (const auto& [property, finding] : check(wanted, request)) {
    EXPECT_EQ(finding.kind, VerdictKind::inconclusive) << property;
    EXPECT_NE(finding.how.find("interrupted"), std::string::npos);
  }
}

TEST_F(ExactRun, RunsTheMutantAgainstTheSpecification) {
  checker::Mutant additive;
  additive.knobs = [](model::Scenario& scenario) {
    scenario.dds.sedp.heartbeat_timer = model::HeartbeatTimerKind::additive;
  };
  const model::Scenario scenario =
      props::shipped("smallest", {"wireless.lost_packets=[2,3,4,5,6,7,8,9,10]"});
  EXPECT_EQ(ask("timer.single-heartbeat", scenario).kind, VerdictKind::observed);
  EXPECT_EQ(ask("timer.single-heartbeat", scenario, &additive).kind, VerdictKind::violated);
  checker::Mutant live;
  live.rules.live_bitmaps = true;
  EXPECT_EQ(ask("safety.snapshot", scenario).kind, VerdictKind::observed);
  EXPECT_EQ(ask("safety.snapshot", props::shipped("wifi-5x20"), &live).kind, VerdictKind::violated);
}

TEST_F(ExactRun, ScenarioToRunIsTheMutants) {
  const model::Scenario scenario = props::shipped("smallest");
  CheckRequest request{scenario, claims_, nullptr, 0, 12, {}};
  EXPECT_EQ(scenario_to_run(request), scenario);
  checker::Mutant mutant;
  request.mutant = &mutant;
  EXPECT_EQ(scenario_to_run(request), scenario);
  mutant.knobs = [](model::Scenario& changed) { changed.time_limit = model::Nanoseconds{7}; };
  EXPECT_EQ(scenario_to_run(request).time_limit, model::Nanoseconds{7});
}

}  // namespace exact_test
}  // namespace stormproof::exact
