// Answers that contradict each other leave nothing established, whatever else was found: two
// solvers, an engine and the simulator about a path, a proof and a run. A solver that merely has no
// answer takes away only the proof.
#include <gtest/gtest.h>

#include "checker/engines/exact/exact.hpp"
#include "checker/engines/smt/claims.hpp"
#include "checker/verification/check/combination.hpp"
#include "checker/verification/check/gate.hpp"
#include "model/config/scenario_file.hpp"
#include "tests/checker/engines/smt/solver_on_path.hpp"

namespace stormproof::checker {
namespace dispute_test {

using props::Engine;
using props::Finding;
using props::VerdictKind;

/// Answers every query so.
std::string always(const std::string& answer) {
  return "for file; do :; done; grep '(check-sat)' \"$file\" | sed 's/.*/" + answer + "/'";
}

model::Scenario shipped(const char* name) {
  return *model::config::read_scenario(name, {}, model::config::SpecPath::standard());
}

/// What a check of this property says if cvc5 is this script.
CheckReport report_with(const std::string& script, std::string_view property) {
  const smt::FakeSolver fake{script};
  const model::Scenario scenario = shipped("smallest");
  smt::Claims claims;
  return check({property}, {scenario, claims, nullptr, 0, 1, {}});
}
VerdictKind verdict_with(const std::string& script) {
  return report_with(script, "safety.ack-implies-received").results.front().verdict;
}

TEST(Dispute, SolversThatContradictEachOther) {
  for (const char* property : {"safety.ack-implies-received", "live.completion"}) {
    const CheckReport report = report_with(always("sat"), property);
    EXPECT_EQ(report.results.front().verdict, VerdictKind::disputed) << property;
    EXPECT_NE(report.results.front().decisive().how.find("the solvers do not agree"),
              std::string::npos);
    EXPECT_EQ(judge(report, model::DdsProfile{}, {}).exit_code, 3);
  }
}

TEST(Dispute, NoAnswerLeavesWhatTheOtherEnginesFound) {
  EXPECT_EQ(verdict_with("echo unknown"), VerdictKind::bounded);
}

TEST(Dispute, AgreementProves) { EXPECT_EQ(verdict_with(always("unsat")), VerdictKind::proved); }

Finding by(Engine engine, VerdictKind kind) {
  Finding finding;
  finding.engine = name_of(engine);
  finding.kind = kind;
  finding.how = "said so";
  return finding;
}

/// The verdict on a property of a scenario, of what engines are made to say.
PropertyResult verdict_on(std::string_view property, const model::Scenario& scenario,
                          const std::vector<Finding>& findings) {
  smt::Claims claims;
  return combined(*props::find_property(property), findings, {scenario, claims, nullptr, 0, 1, {}});
}

TEST(Dispute, APathThatTheSimulatorDoesNotFollow) {
  const model::Scenario scenario = shipped("smallest");
  Finding wrong = by(Engine::explorer, VerdictKind::violated);
  wrong.counterexample.emplace();
  wrong.counterexample->property = "safety.snapshot";
  wrong.counterexample->scenario = scenario;
  wrong.counterexample->event = 3;
  const PropertyResult result = verdict_on("safety.snapshot", scenario,
                                           {by(Engine::tables, VerdictKind::proved),
                                            by(Engine::exact_run, VerdictKind::observed), wrong});
  EXPECT_EQ(result.verdict, VerdictKind::disputed);
  EXPECT_EQ(result.decisive().engine, "explorer");
  EXPECT_NE(result.decisive().how.find("does not happen in the simulator"), std::string::npos);
  EXPECT_EQ(result.counterexample(), nullptr);
  ASSERT_EQ(result.findings.size(), 3U);  // what the others say is kept
  EXPECT_EQ(result.findings.front().kind, VerdictKind::proved);
}

class ProofAndRun : public testing::Test {
 protected:
  ProofAndRun() {
    smt::Claims claims;
    const std::string_view id = "storm.single-copy";
    checker::Findings found = exact::check({&id, 1}, {scenario_, claims, nullptr, 0, 1, {}});
    broken_ = std::move(found.front().second);
  }
  PropertyResult beside(const Finding& other) {
    return verdict_on("storm.single-copy", scenario_, {other, broken_});
  }

  model::Scenario scenario_ = shipped("wifi-5x20");
  Finding broken_;
};

TEST_F(ProofAndRun, ContradictEachOther) {
  ASSERT_EQ(broken_.kind, VerdictKind::violated);
  for (const Engine engine : {Engine::tables, Engine::timelines}) {
    const PropertyResult result = beside(by(engine, VerdictKind::proved));
    EXPECT_EQ(result.verdict, VerdictKind::disputed) << name_of(engine);
    EXPECT_EQ(result.findings.size(), 3U);
    EXPECT_NE(result.decisive().how.find(name_of(engine)), std::string::npos);
    EXPECT_NE(result.decisive().how.find("exact run breaks it"), std::string::npos);
  }
}

TEST_F(ProofAndRun, ContradictEachOtherUpToTheDelayThatTheProofNames) {
  Finding proof = by(Engine::timelines, VerdictKind::proved);
  proof.longest_delay = model::Nanoseconds{1};
  EXPECT_EQ(beside(proof).verdict, VerdictKind::violated);
  proof.longest_delay = model::Nanoseconds{10'000'000'000};
  EXPECT_EQ(beside(proof).verdict, VerdictKind::disputed);
}

TEST_F(ProofAndRun, AScopeThatDoesNotContainTheRunContradictsNothing) {
  EXPECT_EQ(beside(by(Engine::explorer, VerdictKind::bounded)).verdict, VerdictKind::violated);
  EXPECT_EQ(beside(by(Engine::timelines, VerdictKind::inconclusive)).verdict,
            VerdictKind::violated);
}

}  // namespace dispute_test
}  // namespace stormproof::checker
