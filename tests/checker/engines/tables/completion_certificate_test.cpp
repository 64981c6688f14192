// The certificates from the rules: they hold for both writers, nothing stronger does, mistakes
// between the machines break them, and an export can be checked by anyone.
#include "checker/engines/tables/completion_certificate.hpp"

#include <filesystem>
#include <sstream>

#include <z3++.h>

#include "checker/engines/process/process.hpp"
#include "checker/engines/smt/second_solver.hpp"
#include "checker/engines/tables/derived_time.hpp"
#include "checker/engines/tables/timed_descriptor.hpp"
#include "checker/engines/tables/transition_system.hpp"
#include "checker/engines/tables/unrolling.hpp"
#include "tests/checker/engines/tables/effect_mistake.hpp"
#include "tests/checker/engines/tables/table_check.hpp"
#include "tests/files.hpp"

namespace stormproof::tables {
namespace completion_certificate_test {

using fsm::composition::EffectMutation;

Finding certified(const model::Scenario& scenario, const checker::Mutant* mutant = nullptr,
                  const Tighter& tighter = {}, smt::Options options = {.second_solver = false}) {
  smt::Claims claims{std::move(options)};
  const checker::CheckRequest request{
      .scenario = scenario, .claims = claims, .mutant = mutant, .on_progress = {}};
  return completion_certificate(request, tighter);
}

std::vector<model::Scenario> scenarios() {
  model::Scenario pull = paper();
  pull.dds.sedp.initial_data = model::InitialData::pull;
  pull.dds.sedp.relation_opening = model::RelationOpening::each_side;
  pull.dds.sedp.acknowledge = model::Acknowledge::prefix;
  pull.dds.sedp.initial_acknack = model::InitialAckNackReply::heartbeat;
  pull.dds.sedp.heartbeat_recipients = model::HeartbeatRecipients::matched;
  return {paper(), pull, fastdds()};
}

TEST(CompletionCertificate, HoldsForBothWriters) {
  for (const model::Scenario& scenario : scenarios()) {
    const Finding finding = certified(scenario, nullptr, {}, {});
    EXPECT_EQ(finding.kind, VerdictKind::proved) << finding.how;
    EXPECT_TRUE(mentions(finding, "an expiry is pending within τ_H"));
    EXPECT_TRUE(mentions(finding, "sends to its reader"));
    EXPECT_TRUE(mentions(finding, "received by the limit + F"));
  }
}

TEST(CompletionCertificate, NoPartOfTheBoundCanBeSmaller) {
  for (const model::Scenario& scenario : {paper(), fastdds()}) {
    for (const Tighter& tighter : {Tighter{1, 0, 0}, Tighter{0, 1, 0}, Tighter{0, 0, 1}}) {
      EXPECT_EQ(certified(scenario, nullptr, tighter).kind, VerdictKind::inconclusive);
    }
  }
}

TEST(CompletionCertificate, SaysNothingOfOtherTimers) {
  model::Scenario adaptive = fastdds();
  adaptive.dds.sedp.heartbeat_policy = model::HeartbeatPolicy::adaptive;
  model::Scenario additive = paper();
  additive.dds.sedp.heartbeat_timer = model::HeartbeatTimerKind::additive;
  EXPECT_NE(certified(adaptive).how.find("adaptive"), std::string::npos);
  EXPECT_NE(certified(additive).how.find("additive"), std::string::npos);
}

TEST(CompletionCertificate, MistakesBetweenTheMachinesBreakIt) {
  using Change = EffectMutation::Change;
  struct Mistake {
    model::Scenario scenario;
    const char* rule;
    const char* what;
    Change change;
  };
  for (const Mistake& mistake :
       {Mistake{paper(), "AckNackArrives", "after RepairGeneration", Change::drop},
        Mistake{paper(), "AckNackArrives", "after RepairGeneration", Change::other_delay},
        Mistake{paper(), "RepairHasLeft", "after SuppressionEnd", Change::drop},
        Mistake{paper(), "ClockGoesOn", "at HeartbeatExpiry", Change::drop},
        Mistake{paper(), "DataArrives", "set each X", Change::drop},
        Mistake{fastdds(), "NackResponds", "perform Enqueue", Change::drop},
        Mistake{fastdds(), "SuppressionEnds", "feed each C", Change::drop},
        Mistake{fastdds(), "AckNackDue", "emit AckNack", Change::drop}}) {
    const checker::Mutant mutant =
        at_effect(mistake.scenario, mistake.rule, mistake.what, mistake.change);
    if (mutant.rules.effects.empty()) continue;
    const Finding finding = certified(mistake.scenario, &mutant);
    EXPECT_EQ(finding.kind, VerdictKind::inconclusive) << mistake.rule << ": " << mistake.what;
    EXPECT_TRUE(mentions(finding, "lost at") || mentions(finding, "not so"));
  }
}

/// An expiry that comes too late, or not at all, breaks the lemma.
TEST(CompletionCertificate, TheLemmaNoticesAnExpiryThatIsLate) {
  checker::Mutant mutant;
  mutant.rules.events.push_back({model::EventKind::heartbeat_expiry,
                                 model::EventMutation::Change::shift,
                                 model::Nanoseconds{1},
                                 {}});
  for (const model::Scenario& scenario : {paper(), fastdds()}) {
    smt::Claims claims{{.second_solver = false}};
    const checker::CheckRequest request{
        .scenario = scenario, .claims = claims, .mutant = &mutant, .on_progress = {}};
    const Finding finding = completion_certificate(request);
    EXPECT_EQ(finding.kind, VerdictKind::inconclusive);
    EXPECT_TRUE(mentions(finding, "HeartbeatExpiry: what is pending is due within its delay"));
  }
}

/// What a proof says of a system in which time or packets cannot pass would be nothing.
TEST(CompletionCertificate, IsAboutSystemsThatMove) {
  z3::context context;
  const smt::SymbolicContext current{context};
  for (const model::Scenario& scenario : {paper(), fastdds()}) {
    const TimedDescriptor descriptor{scenario.dds, {}, {}};
    const Moving moving{descriptor.whole()};
    TransitionSystem system = moving.system;
    for (const Expr& given : descriptor.assumptions()) system.initial = system.initial && given;
    system.bad = moving(descriptor[watched::counting] && descriptor["X"] &&
                        descriptor[timed::now] >= 3 + descriptor.delays().period.expr());
    Unrolling unrolling{system};
    z3::check_result result = z3::unsat;
    for (unsigned length = 1; length <= 12 && result != z3::sat; ++length) {
      unrolling.extend();
      z3::solver solver{context, z3::solver::simple()};
      for (const Expr& condition : unrolling.ends_badly()) solver.add(condition);
      result = solver.check();
    }
    EXPECT_EQ(result, z3::sat) << "X is never received, or time never passes";
  }
}

/// Answers, one in each line; only unsat is as it should be.
void expect_unsat(const std::string& answers) {
  std::istringstream lines{answers};
  std::size_t count = 0;
  for (std::string line; std::getline(lines, line); ++count) EXPECT_EQ(line, "unsat");
  EXPECT_GT(count, 20U);
}

TEST(CompletionCertificate, IsExportedForOthersToCheck) {
  const files::Folder own;
  const std::filesystem::path& folder = own.path();
  for (const model::Scenario& scenario : {paper(), fastdds()}) {
    certified(scenario, nullptr, {}, {.export_dir = folder.string(), .second_solver = false});
    const auto file = folder / "certificates" / "live.completion.rules.smt2";
    const std::string text = files::content(file);
    EXPECT_NE(text.find("(define-fun invariant"), std::string::npos);
    z3::context context;
    expect_unsat(Z3_eval_smtlib2_string(context, text.c_str()));
    if (smt::second_solver_name().empty()) continue;
    const process::Run run = process::run({.arguments = {"cvc5", "--incremental", file.string()},
                                           .limit = std::chrono::seconds{120}});
    expect_unsat(run.output);
  }
}

}  // namespace completion_certificate_test
}  // namespace stormproof::tables
