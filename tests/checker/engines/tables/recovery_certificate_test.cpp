// The certificates of recovery: they hold for the proposed rule with and without the timer of the
// repair of 2022, and for none of the rules that only look like one; nothing stronger holds, and
// mistakes between the machines break them.
#include "checker/engines/tables/recovery_certificate.hpp"

#include <sstream>

#include <z3++.h>

#include "checker/engines/tables/unrolling.hpp"
#include "props/monitors/recovery_bound.hpp"
#include "tests/checker/engines/tables/effect_mistake.hpp"
#include "tests/checker/engines/tables/table_check.hpp"
#include "tests/files.hpp"
#include "tests/props/monitored_run.hpp"

namespace stormproof::tables {
namespace recovery_certificate_test {

using fsm::composition::EffectMutation;
using model::Whether;

/// The scenario of the proposed rule.
model::Scenario proposed() { return props::shipped("rejoin-6401"); }

model::Scenario with(const std::function<void(model::Scenario&)>& change) {
  model::Scenario scenario = proposed();
  change(scenario);
  return scenario;
}

Finding certified(const model::Scenario& scenario, Before before,
                  const checker::Mutant* mutant = nullptr, const Tighter& tighter = {},
                  smt::Options options = {.second_solver = false}) {
  smt::Claims claims{std::move(options)};
  const checker::CheckRequest request{
      .scenario = scenario, .claims = claims, .mutant = mutant, .on_progress = {}};
  return recovery_certificate(request, before, tighter);
}

TEST(RecoveryCertificate, HoldsForTheProposedRule) {
  for (const model::Scenario& scenario :
       {proposed(), with([](auto& s) { s.dds.amendments->initial_acknack_arms = Whether::no; }),
        with([](auto& s) {
          s.dds.sedp.initial_acknack_interval = model::InitialAckNackInterval::constant;
        }),
        with([](auto& s) { s.dds.amendments->acked_request = model::AckedRequest::reopen; }),
        with([](auto& s) { s.dds.sedp.heartbeat_policy = model::HeartbeatPolicy::adaptive; })}) {
    for (const Before before : {Before::fresh, Before::stale}) {
      const Finding finding = certified(scenario, before);
      EXPECT_EQ(finding.kind, VerdictKind::proved) << finding.how;
      EXPECT_TRUE(mentions(finding, "whoever lacks it goes on asking"));
      EXPECT_TRUE(mentions(finding, "received by the limit + F"));
    }
  }
}

/// The rules of today, each repair that is none, and where each fails.
TEST(RecoveryCertificate, FailsForRulesThatDoNotRecover) {
  const auto today = [](model::Scenario& s) {
    s.dds.amendments->initial_acknack_stop = model::InitialAckNackStop::any_heartbeat;
  };
  const auto expect_lost = [](const model::Scenario& scenario, const char* words, const char* step,
                              const char* state) {
    const Finding finding = certified(scenario, Before::stale);
    EXPECT_EQ(finding.kind, VerdictKind::inconclusive) << finding.how;
    EXPECT_TRUE(mentions(finding, std::string{words} + "' is lost at: " + step)) << step;
    EXPECT_TRUE(mentions(finding, state)) << state;
  };
  const char* const asks = "whoever lacks it goes on asking";
  const char* const under_way =
      "what is missing is on its way, or asked for, or an attempt will ask for it, in time";
  expect_lost(with(today), asks, "InitialAckNackDue", "HeartbeatSeen");
  expect_lost(with([&](auto& s) {
                today(s);
                s.dds.amendments->acked_request = model::AckedRequest::reopen;
              }),
              asks, "InitialAckNackDue", "HeartbeatSeen");
  expect_lost(with([](auto& s) {
                s.dds.amendments->initial_acknack_repeat = model::InitialAckNackRepeat::once;
              }),
              "an attempt is pending, and only one, exactly while it is waited for",
              "InitialAckNackDue", "pending InitialAttempt = 1");
  expect_lost(with([](auto& s) { s.dds.amendments->initial_acknack_resets = Whether::no; }),
              under_way, "AckNackArrives", "in flight initial AckNack");
  expect_lost(
      with([](auto& s) { s.dds.amendments->late_initial = model::LateInitial::ignore_after_ack; }),
      under_way, "AckNackArrives", "HasAnswered");
}

/// Without a reader that was forgotten nothing has to be taken back.
TEST(RecoveryCertificate, TellsStaleRelationsFromFreshOnes) {
  const model::Scenario scenario =
      with([](auto& s) { s.dds.amendments->initial_acknack_resets = Whether::no; });
  EXPECT_EQ(certified(scenario, Before::fresh).kind, VerdictKind::proved);
}

TEST(RecoveryCertificate, NoPartOfTheBoundCanBeSmaller) {
  for (const Tighter& tighter : {Tighter{1, 0, 0}, Tighter{0, 1, 0}, Tighter{0, 0, 1}}) {
    EXPECT_EQ(certified(proposed(), Before::stale, nullptr, tighter).kind,
              VerdictKind::inconclusive);
  }
}

TEST(RecoveryCertificate, MistakesBetweenTheMachinesBreakIt) {
  using Change = EffectMutation::Change;
  struct Mistake {
    const char* rule;
    const char* what;
    Change change;
  };
  for (const Mistake& mistake : {Mistake{"AnswerInitial", "feed each C", Change::drop},
                                 Mistake{"SendHeartbeat", "emit Heartbeat", Change::drop},
                                 Mistake{"ReaderOpened", "at InitialAttempt", Change::drop},
                                 Mistake{"InitialAckNackDue", "at InitialAttempt", Change::drop},
                                 Mistake{"TakeAckNack", "after RepairGeneration", Change::drop},
                                 Mistake{"RepairHasLeft", "after SuppressionEnd", Change::drop},
                                 Mistake{"DataArrives", "set each X", Change::drop}}) {
    const checker::Mutant mutant =
        at_effect(proposed(), mistake.rule, mistake.what, mistake.change);
    ASSERT_FALSE(mutant.rules.effects.empty()) << mistake.rule << ": " << mistake.what;
    const Finding finding = certified(proposed(), Before::stale, &mutant);
    EXPECT_EQ(finding.kind, VerdictKind::inconclusive) << mistake.rule << ": " << mistake.what;
    EXPECT_TRUE(mentions(finding, "lost at") || mentions(finding, "not so"));
  }
}

/// What a proof says of a system in which time or packets cannot pass would be nothing.
TEST(RecoveryCertificate, IsAboutSystemsThatMove) {
  z3::context context;
  const smt::SymbolicContext current{context};
  const TimedDescriptor descriptor{proposed().dds, {}, {.attempts = true, .stale = true}};
  const Moving moving{descriptor.whole()};
  TransitionSystem system = moving.system;
  for (const Expr& given : descriptor.assumptions()) system.initial = system.initial && given;
  system.initial = system.initial && descriptor.initial() >= 1;
  // Received at the second attempt: the first one was lost.
  system.bad = moving(descriptor["X"] && descriptor["LastDelay"] >= 4 * descriptor.initial() &&
                      descriptor[timed::limit] > descriptor[timed::now]);
  Unrolling unrolling{system};
  z3::check_result result = z3::unsat;
  for (unsigned length = 1; length <= 14 && result != z3::sat; ++length) {
    unrolling.extend();
    z3::solver solver{context, z3::solver::simple()};
    for (const Expr& condition : unrolling.ends_badly()) solver.add(condition);
    result = solver.check();
  }
  EXPECT_EQ(result, z3::sat) << "X is never received, or time never passes";
}

/// Both solvers.
TEST(RecoveryCertificate, IsTheProofOfTheProperty) {
  const Finding finding = decide("live.recovery", proposed(), nullptr, {});
  EXPECT_EQ(finding.kind, VerdictKind::proved) << finding.how;
  const auto assumes = [&](const char* words) {
    return std::ranges::any_of(finding.assumptions, [&](const std::string& line) {
      return line.find(words) != std::string::npos;
    });
  };
  EXPECT_TRUE(assumes("recognise each other"));
  EXPECT_TRUE(assumes("neither side forgets"));
  EXPECT_TRUE(assumes("earlier life"));
}

/// What the certificates are compared with is what runs are held against.
TEST(RecoveryCertificate, ComparesWithTheBoundOfTheProperty) {
  for (const bool doubles : {true, false}) {
    model::Scenario scenario = proposed();
    model::SedpProfile& sedp = scenario.dds.sedp;
    sedp.heartbeat_period = model::Nanoseconds{100'000};
    sedp.heartbeat_response_delay = model::Nanoseconds{2'000};
    sedp.nack_response_delay = model::Nanoseconds{300};
    sedp.nack_suppression_duration = model::Nanoseconds{40};
    sedp.initial_acknack_delay = model::Nanoseconds{5'000'000};
    sedp.initial_acknack_interval =
        doubles ? model::InitialAckNackInterval::doubling : model::InitialAckNackInterval::constant;
    constexpr std::int64_t failed = 60'000'000;
    const std::int64_t announced =
        2 * std::max(scenario.dds.spdp.period, scenario.dds.spdp.startup_period).count();
    EXPECT_EQ(
        props::recovery_bound(scenario, model::Nanoseconds{failed}, model::Nanoseconds{7}).count(),
        announced + recovery_after<fsm::Plain>({.period = 100'000,
                                                .response = 2'000,
                                                .nack = 300,
                                                .suppression = 40,
                                                .delta = 7,
                                                .source = 7},
                                               5'000'000, failed, doubles));
  }
}

TEST(RecoveryCertificate, SaysNothingOfOtherDeployments) {
  const auto how = [](const std::function<void(model::Scenario&)>& change) {
    const Finding finding = decide("live.recovery", with(change));
    EXPECT_EQ(finding.kind, VerdictKind::inconclusive);
    return finding.how;
  };
  EXPECT_NE(how([](auto& s) { s.dds.sedp.initial_acknack_delay = {}; }).find("no reader asks"),
            std::string::npos);
  EXPECT_NE(how([](auto& s) {
              s.deployment.life->lease = model::Nanoseconds{1'000'000'000};
            }).find("can forget"),
            std::string::npos);
  EXPECT_NE(how([](auto& s) {
              s.deployment.life->endpoints.push_back({0, 1, 0, {}, {}});
            }).find("endpoints are created"),
            std::string::npos);
}

TEST(RecoveryCertificate, IsExportedForOthersToCheck) {
  const files::Folder folder;
  certified(proposed(), Before::stale, nullptr, {},
            {.export_dir = folder.path().string(), .second_solver = false});
  const std::string text =
      files::content(folder.path() / "certificates" / "live.recovery.stale.rules.smt2");
  EXPECT_NE(text.find("(define-fun invariant"), std::string::npos);
  z3::context context;
  std::istringstream answers{Z3_eval_smtlib2_string(context, text.c_str())};
  std::size_t count = 0;
  for (std::string line; std::getline(answers, line); ++count) EXPECT_EQ(line, "unsat");
  EXPECT_GT(count, 20U);
}

}  // namespace recovery_certificate_test
}  // namespace stormproof::tables
