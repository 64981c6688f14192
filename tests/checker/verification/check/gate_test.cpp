// Which verdicts make a check fail, and what a baseline accepts.
#include "checker/verification/check/gate.hpp"

#include <filesystem>
#include <fstream>

#include <gtest/gtest.h>

#include "checker/engines/smt/claims.hpp"
#include "checker/verification/check/baseline.hpp"
#include "checker/verification/check/combination.hpp"
#include "model/config/scenario_file.hpp"

namespace stormproof::checker {
namespace gate_test {

using props::Finding;
using props::Reach;
using props::VerdictKind;

Finding by(props::Engine engine, VerdictKind kind) {
  Finding finding;
  finding.engine = props::name_of(engine);
  finding.kind = kind;
  return finding;
}

PropertyResult result_of(std::string_view id, std::vector<Finding> findings) {
  PropertyResult result;
  result.property = props::find_property(id);
  result.findings = std::move(findings);
  result.deciding = deciding_finding(result.findings);
  result.verdict = result.decisive().kind;
  return result;
}

Gate judged(PropertyResult result, GateRules rules = {}) {
  CheckReport report;
  report.results.push_back(std::move(result));
  return judge(report, model::DdsProfile{}, std::move(rules));
}

Standing standing(PropertyResult result, GateRules rules = {}) {
  return judged(std::move(result), std::move(rules)).standings.front();
}

constexpr auto run = props::Engine::exact_run;
constexpr auto tables = props::Engine::tables;
constexpr auto explorer = props::Engine::explorer;

TEST(Gate, WhatBreaksInThisDeploymentFailsWhateverTheRulesPromise) {
  for (const char* id : {"safety.snapshot", "storm.single-copy", "limit.time"}) {
    const Gate gate = judged(result_of(id, {by(run, VerdictKind::violated)}));
    EXPECT_EQ(gate.standings.front(), Standing::fails) << id;
    EXPECT_EQ(gate.exit_code, 1) << id;
    EXPECT_EQ(gate.failures, (std::vector<Failure>{{id, Reach::deployment}})) << id;
  }
}

TEST(Gate, AWeaknessThatOtherDeploymentsHaveIsPossibleAndFailsIfStrict) {
  const PropertyResult weak = result_of(
      "live.quiescence", {by(run, VerdictKind::bounded), by(explorer, VerdictKind::violated)});
  EXPECT_EQ(weak.verdict, VerdictKind::violated);
  EXPECT_EQ(standing(weak), Standing::possible);
  EXPECT_EQ(judged(weak).exit_code, 0);
  const Gate strict = judged(weak, {.strict = true});
  EXPECT_EQ(strict.exit_code, 1);
  EXPECT_EQ(strict.failures, (std::vector<Failure>{{"live.quiescence", Reach::profile}}));
}

TEST(Gate, WhatTheRulesPromiseFailsWhereverItBreaks) {
  EXPECT_EQ(standing(result_of("safety.snapshot", {by(run, VerdictKind::bounded),
                                                   by(explorer, VerdictKind::violated)})),
            Standing::fails);
  EXPECT_EQ(standing(result_of("fsm.determinism", {by(tables, VerdictKind::violated)})),
            Standing::fails);
}

TEST(Gate, AMarginIsNoFailureOfTheRunThatIsBeyondIt) {
  const PropertyResult margin = result_of("storm.free-threshold", {by(run, VerdictKind::violated)});
  EXPECT_EQ(standing(margin), Standing::possible);
  EXPECT_EQ(standing(margin, {.strict = true}), Standing::fails);
}

TEST(Gate, WeaknessesAreThoseOfTheImplementation) {
  const PropertyResult result =
      result_of("timer.suppression-honoured",
                {by(run, VerdictKind::bounded), by(explorer, VerdictKind::violated)});
  CheckReport report;
  report.results.push_back(result);
  model::DdsProfile dds;
  EXPECT_EQ(judge(report, dds, {}).exit_code, 1);
  dds.implementation = model::ImplementationKind::fastdds;
  EXPECT_EQ(judge(report, dds, {}).exit_code, 0);
}

TEST(Gate, WhatIsPromisedHasToBeEstablishedAsStronglyAsRequired) {
  const PropertyResult bounded = result_of("safety.snapshot", {by(run, VerdictKind::bounded)});
  EXPECT_EQ(judged(bounded, {.require = VerdictKind::bounded}).exit_code, 0);
  EXPECT_EQ(judged(bounded, {.require = VerdictKind::proved}).exit_code, 3);
  EXPECT_EQ(standing(bounded, {.require = VerdictKind::proved}), Standing::open);
  EXPECT_EQ(judged(result_of("safety.snapshot", {by(run, VerdictKind::inconclusive)})).exit_code,
            3);
  // A weakness is not promised, and a limit is no rule: they have no kind to reach.
  const PropertyResult weak = result_of("live.quiescence", {by(run, VerdictKind::bounded)});
  EXPECT_EQ(judged(weak, {.require = VerdictKind::proved}).exit_code, 0);
  EXPECT_EQ(judged(weak, {.require = VerdictKind::proved, .strict = true}).exit_code, 3);
  const PropertyResult limit = result_of("limit.time", {by(run, VerdictKind::sampled)});
  EXPECT_EQ(judged(limit, {.require = VerdictKind::proved}).exit_code, 0);
}

TEST(Gate, ADisputeOverrulesEverythingEvenAFailureAndAWeakness) {
  const PropertyResult disputed = result_of(
      "live.quiescence", {by(run, VerdictKind::violated), by(tables, VerdictKind::disputed)});
  EXPECT_EQ(standing(disputed), Standing::disputed);
  EXPECT_EQ(judged(disputed).exit_code, 3);
  EXPECT_EQ(judged(disputed, {.baseline = {{"live.quiescence", Reach::deployment}}}).exit_code, 3);
  CheckReport report;
  report.results = {disputed, result_of("safety.snapshot", {by(run, VerdictKind::violated)})};
  const Gate gate = judge(report, model::DdsProfile{}, {});
  EXPECT_EQ(gate.count(Standing::fails), 1U);
  EXPECT_EQ(gate.exit_code, 3);
}

TEST(Gate, KindsThatAreRequiredAreInTheOrderOfTheirStrength) {
  const std::vector order{VerdictKind::proved, VerdictKind::bounded, VerdictKind::sampled,
                          VerdictKind::observed};
  for (std::size_t has = 0; has < order.size(); ++has) {
    for (std::size_t required = 0; required < order.size(); ++required) {
      EXPECT_EQ(
          judged(result_of("safety.snapshot", {by(run, order[has])}), {.require = order[required]})
              .exit_code,
          has <= required ? 0 : 3)
          << name_of(order[has]) << ", required " << name_of(order[required]);
    }
  }
}

TEST(Gate, AnInterruptedCheckIsOpen) {
  CheckReport report;
  report.interrupted = true;
  EXPECT_EQ(judge(report, model::DdsProfile{}, {}).exit_code, 3);
}

TEST(Gate, AStormFailsEvenIfNoPropertyBreaks) {
  exact::RunHealth storm;
  storm.health = exact::Health::storm;
  storm.completion = model::Nanoseconds{5};
  CheckReport report;
  report.outlook.emplace(std::vector{storm});
  EXPECT_EQ(judge(report, model::DdsProfile{}, {}).exit_code, 1);
  const GateRules accepting{.baseline = {{std::string{storm_id}, Reach::deployment}}};
  EXPECT_EQ(judge(report, model::DdsProfile{}, accepting).exit_code, 0);
}

/// Whatever was asked: who looks at one property does not pass a discovery that never completes.
TEST(Gate, ADiscoveryThatDoesNotCompleteFailsWhateverWasAsked) {
  exact::RunHealth incomplete;
  incomplete.health = exact::Health::incomplete;
  CheckReport report;
  report.outlook.emplace(std::vector{incomplete});
  report.results = {result_of("live.completion", {by(tables, VerdictKind::proved)})};
  const Gate gate = judge(report, model::DdsProfile{}, {});
  EXPECT_EQ(gate.exit_code, 1);
  const std::vector<Failure> failures{{std::string{incomplete_id}, Reach::deployment}};
  EXPECT_EQ(gate.failures, failures);
  EXPECT_EQ(judge(report, model::DdsProfile{}, {.baseline = failures}).exit_code, 0);
  // One run of several is enough; where limit.time is judged, it is the one that fails.
  exact::RunHealth fine;
  fine.completion = model::Nanoseconds{5};
  report.outlook.emplace(std::vector{fine, incomplete, fine});
  EXPECT_EQ(judge(report, model::DdsProfile{}, {}).exit_code, 1);
  report.results.push_back(result_of("limit.time", {by(run, VerdictKind::violated)}));
  EXPECT_EQ(judge(report, model::DdsProfile{}, {}).failures, failures);
  report.outlook.emplace(std::vector{fine});
  report.results.pop_back();
  EXPECT_EQ(judge(report, model::DdsProfile{}, {}).exit_code, 0);
}

/// Whoever describes a fleet cannot mend the library that it uses.
TEST(Gate, WhatALibraryDoesIsNoFailureOfADeployment) {
  const PropertyResult broken =
      result_of("timer.suppression-honoured", {by(run, VerdictKind::violated)});
  EXPECT_EQ(answer_to(Reach::deployment, broken), nullptr);
  EXPECT_EQ(answer_to(Reach::profile, broken)->kind, VerdictKind::violated);
  CheckReport report;
  report.results.push_back(broken);
  model::DdsProfile dds;
  dds.implementation = model::ImplementationKind::fastdds;
  EXPECT_EQ(judge(report, dds, {}).exit_code, 0);
  EXPECT_EQ(judge(report, dds, {.strict = true}).exit_code, 1);
  // The paper's writer promises it.
  EXPECT_EQ(judge(report, model::DdsProfile{}, {}).exit_code, 1);
}

/// What holds in small scopes, or up to some delay, is refuted by a run of the profile.
TEST(Gate, NothingHoldsForAProfileOfWhichARunBreaksIt) {
  for (const VerdictKind kind : {VerdictKind::proved, VerdictKind::bounded}) {
    const PropertyResult broken =
        result_of("safety.snapshot", {by(explorer, kind), by(run, VerdictKind::violated)});
    EXPECT_EQ(answer_to(Reach::deployment, broken)->kind, VerdictKind::violated);
    EXPECT_EQ(answer_to(Reach::profile, broken)->kind, VerdictKind::violated);
    EXPECT_EQ(judged(broken).failures,
              (std::vector<Failure>{{"safety.snapshot", Reach::deployment}}));
  }
  // What only runs tell is no answer about all of them, unless one breaks it.
  const PropertyResult kept = result_of("storm.free-threshold", {by(run, VerdictKind::observed)});
  EXPECT_EQ(answer_to(Reach::profile, kept), nullptr);
  EXPECT_EQ(answer_to(Reach::deployment, kept)->kind, VerdictKind::observed);
  const PropertyResult limit = result_of("limit.time", {by(run, VerdictKind::violated)});
  EXPECT_EQ(answer_to(Reach::profile, limit), nullptr);
}

/// Nobody has found that it can break.
TEST(Gate, WhatNobodyHasLookedAtIsNotPossible) {
  const PropertyResult asked = result_of("storm.cannot-start", {Finding{}});
  EXPECT_EQ(standing(asked), Standing::unknown);
  EXPECT_EQ(judged(asked).exit_code, 0);
  EXPECT_EQ(judged(asked, {.strict = true}).exit_code, 3);
  const PropertyResult missed =
      result_of("storm.cannot-start", {by(props::Engine::calculus, VerdictKind::inconclusive)});
  EXPECT_EQ(standing(missed), Standing::possible);
}

TEST(Gate, ABaselineAcceptsWhatItListsAndNothingElse) {
  const PropertyResult broken = result_of("storm.single-copy", {by(run, VerdictKind::violated)});
  const Gate accepted = judged(broken, {.baseline = {{"storm.single-copy", Reach::deployment}}});
  EXPECT_EQ(accepted.exit_code, 0);
  EXPECT_EQ(accepted.standings.front(), Standing::accepted);
  EXPECT_TRUE(accepted.outdated.empty());
  const Gate elsewhere = judged(broken, {.baseline = {{"storm.single-copy", Reach::profile}}});
  EXPECT_EQ(elsewhere.exit_code, 1);
  EXPECT_EQ(elsewhere.outdated.size(), 1U);
}

class BaselineFile : public testing::Test {
 protected:
  std::string error_of(const std::string& text) {
    std::ofstream{path_} << text;
    const auto baseline = read_baseline(path_);
    return baseline ? "" : to_string(baseline.error());
  }
  ~BaselineFile() override { std::filesystem::remove(path_); }

  std::string path_ = testing::TempDir() + "stormproof-baseline.yaml";
};

TEST_F(BaselineFile, IsReadAsItIsWritten) {
  const Baseline baseline{{"a: \"b\" c", {{"safety.snapshot", Reach::rules}}},
                          {"wifi-5x20",
                           {{std::string{storm_id}, Reach::deployment},
                            {"storm.single-copy", Reach::deployment},
                            {"live.quiescence", Reach::profile}}}};
  std::ofstream{path_} << baseline_text(baseline);
  const auto read = read_baseline(path_);
  ASSERT_TRUE(read) << to_string(read.error());
  EXPECT_EQ(*read, baseline);
}

TEST_F(BaselineFile, MistakesAreRefusedWithTheirPlace) {
  EXPECT_NE(error_of("acepted: {}").find(":1:1"), std::string::npos);
  EXPECT_NE(error_of("{}").find("expected 'accepted:'"), std::string::npos);
  EXPECT_NE(error_of("accepted:\n  x: 3\n").find(":2:6: x: '3'; expected a list"),
            std::string::npos);
  EXPECT_NE(error_of("accepted:\n  x:\n    - storm.single-coppy in this deployment\n")
                .find("did you mean 'storm.single-copy'?"),
            std::string::npos);
  EXPECT_NE(error_of("accepted:\n  x:\n    - storm.single-copy somewhere\n").find(":3:7"),
            std::string::npos);
  EXPECT_FALSE(read_baseline(path_ + ".none"));
}

std::map<std::string, int> exit_codes() {
  std::map<std::string, int> codes;
  for (const char* name : {"smallest", "wired-5x20", "wired-5x20-fastdds", "wifi-5x20"}) {
    const auto scenario =
        model::config::read_scenario(name, {}, model::config::SpecPath::standard());
    smt::Options solver;
    solver.second_solver = false;
    smt::Claims claims{solver};
    const CheckReport report = check({}, {*scenario, claims, nullptr, 0, 2, {}});
    codes[name] = judge(report, scenario->dds, {}).exit_code;
  }
  return codes;
}

TEST(Gate, WiredAndSmallDeploymentsPassAndAStormDoesNot) {
  EXPECT_EQ(exit_codes(),
            (std::map<std::string, int>{
                {"smallest", 0}, {"wired-5x20", 0}, {"wired-5x20-fastdds", 0}, {"wifi-5x20", 1}}));
}

}  // namespace gate_test
}  // namespace stormproof::checker
