// The unbounded safety properties and the timer: proved with an invariant that both solvers check,
// and violated with the shortest steps when a rule is wrong.
#include <filesystem>
#include <sstream>

#include "checker/engines/smt/second_solver.hpp"
#include "checker/engines/tables/transition_system.hpp"
#include "tests/checker/engines/smt/solver_on_path.hpp"
#include "tests/checker/engines/tables/table_check.hpp"
#include "tests/files.hpp"

namespace stormproof::tables {
namespace safety_test {

using Kind = fsm::TableMutation::Kind;
using model::EventKind;
using model::EventMutation;

model::Scenario prefix() {
  model::Scenario scenario;
  scenario.dds.sedp.acknowledge = model::Acknowledge::prefix;
  return scenario;
}
model::Scenario adaptive() {
  model::Scenario scenario;
  scenario.dds.sedp.heartbeat_policy = model::HeartbeatPolicy::adaptive;
  return scenario;
}

TEST(Safety, IsProvedWithAnInvariant) {
  for (const char* const property : {"safety.ack-implies-received", "safety.repair-only-if-asked",
                                     "safety.snapshot", "timer.single-heartbeat"}) {
    for (const model::Scenario& scenario :
         {paper(), fastdds(), with_server(), prefix(), adaptive()}) {
      expect_proved(property, scenario);
    }
    EXPECT_TRUE(mentions(decide(property, paper()), "invariant:")) << property;
    EXPECT_FALSE(decide(property, paper()).assumptions.empty()) << property;
  }
}

TEST(AckImpliesReceived, TheInvariantIsTheOneThatOneExpects) {
  EXPECT_TRUE(mentions(decide("safety.ack-implies-received", paper()), "C=A implies X"));
}

TEST(AckImpliesReceived, AcknowledgingWhatIsListedIsFound) {
  const std::size_t row = row_of("DescriptorRepair", "U", "AckNackReceived", "A");
  const auto mutant = with_row("DescriptorRepair", row, Kind::ignore_guard);
  const Finding finding = decide("safety.ack-implies-received", paper(), &mutant);
  EXPECT_EQ(finding.kind, VerdictKind::violated);
  EXPECT_TRUE(mentions(finding, "after 4 steps"));
  EXPECT_TRUE(mentions(finding, "sent AckNack Listed"));
  EXPECT_TRUE(mentions(finding, "4. AckNackArrives (Listed"));
  EXPECT_TRUE(mentions(finding, ": C=A"));
  EXPECT_FALSE(finding.counterexample);
}

TEST(AckImpliesReceived, ARequestThatAcknowledgesIsFound) {
  const std::size_t row = row_of("DescriptorRepair", "U", "AckNackReceived", "R");
  expect_violated(
      "safety.ack-implies-received", prefix(),
      with_row("DescriptorRepair", row, Kind::retarget, 0, state_of("DescriptorRepair", "A")),
      "C=A");
  const std::size_t real = row_of("ChangeForReader", "Q", "AckNackReceived", "A");
  expect_violated("safety.ack-implies-received", fastdds(),
                  with_row("ChangeForReader", real, Kind::negate_guard), "C=A");
}

TEST(Safety, OfAServersClientsSaysWhomItIsAbout) {
  const auto& assumptions = decide("safety.snapshot", with_server()).assumptions;
  EXPECT_TRUE(std::ranges::any_of(assumptions, [](const std::string& assumed) {
    return assumed.find("what clients tell the server") != std::string::npos;
  }));
  const std::size_t row = row_of("ChangeForReader", "Q", "AckNackReceived", "A");
  expect_violated("safety.ack-implies-received", with_server(),
                  with_row("ChangeForReader", row, Kind::negate_guard), "C=A");
}

TEST(Safety, OfCycloneDdsIsProvedWithAnInvariant) {
  for (const char* const property : {"safety.ack-implies-received", "safety.snapshot"}) {
    expect_proved(property, cyclone());
    EXPECT_TRUE(mentions(decide(property, cyclone()), "invariant:")) << property;
    EXPECT_FALSE(decide(property, cyclone()).assumptions.empty()) << property;
  }
  EXPECT_TRUE(mentions(decide("safety.ack-implies-received", cyclone()), "implies X"));
}

TEST(AckImpliesReceived, AReaderOfCycloneDdsThatRepliesTooEarlyIsFound) {
  const std::size_t row = row_of("MatchedReader", "Silent", "AckNackReceived", "Replied");
  for (const Kind kind : {Kind::ignore_guard, Kind::negate_guard}) {
    expect_violated("safety.ack-implies-received", cyclone(), with_row("MatchedReader", row, kind),
                    "has acknowledged a sample");
  }
}

TEST(AckImpliesReceived, AReaderOfCycloneDdsThatIsMatchedTwiceIsFound) {
  const std::size_t row = row_of("MatchedReader", "Unmatched", "Opened", "Silent");
  const std::uint8_t replied = state_of("MatchedReader", "Replied");
  expect_violated("safety.ack-implies-received", cyclone(),
                  with_row("MatchedReader", row, Kind::copy_row, replied, replied),
                  "has acknowledged a sample");
}

TEST(RepairOnlyIfAsked, ARequestForWhatIsNotListedIsFound) {
  // With bitmaps a negated guard changes nothing here: what is not listed is confirmed first.
  const std::size_t row = row_of("DescriptorRepair", "U", "AckNackReceived", "R");
  expect_violated("safety.repair-only-if-asked", prefix(),
                  with_row("DescriptorRepair", row, Kind::negate_guard), "nobody asked for");
  const std::size_t confirmed = row_of("DescriptorRepair", "U", "AckNackReceived", "A");
  expect_violated(
      "safety.repair-only-if-asked", paper(),
      with_row("DescriptorRepair", confirmed, Kind::retarget, 0, state_of("DescriptorRepair", "R")),
      "nobody asked for");
  const std::size_t real = row_of("ChangeForReader", "Absent", "ReaderMatched", "U");
  expect_violated(
      "safety.repair-only-if-asked", fastdds(),
      with_row("ChangeForReader", real, Kind::retarget, 0, state_of("ChangeForReader", "R")),
      "QueueIsSent");
}

TEST(RepairOnlyIfAsked, ARequestCountsOnlyOnce) {
  // A second repair for one ACKNACK: back to R when the suppression ends.
  const std::size_t ends = row_of("DescriptorRepair", "S", "SuppressionEnded", "U");
  expect_violated(
      "safety.repair-only-if-asked", paper(),
      with_row("DescriptorRepair", ends, Kind::retarget, 0, state_of("DescriptorRepair", "R")),
      "nobody asked for");
  const std::size_t real = row_of("ChangeForReader", "S", "SuppressionEnded", "U");
  expect_violated(
      "safety.repair-only-if-asked", fastdds(),
      with_row("ChangeForReader", real, Kind::retarget, 0, state_of("ChangeForReader", "R")),
      "nobody asked for");
}

TEST(RepairOnlyIfAsked, TheInvariantIsTheOneThatOneExpects) {
  EXPECT_TRUE(mentions(decide("safety.repair-only-if-asked", paper()), "C=R implies asked"));
}

TEST(Snapshot, ALiveBitmapIsFound) {
  checker::Mutant mutant;
  mutant.rules.live_bitmaps = true;
  for (const model::Scenario& scenario : {paper(), fastdds()}) {
    expect_violated("safety.snapshot", scenario, mutant, "has changed on its way");
  }
}

TEST(SingleHeartbeat, TheAdditiveTimerIsFound) {
  model::Scenario scenario;
  scenario.dds.sedp.heartbeat_timer = model::HeartbeatTimerKind::additive;
  const Finding finding = decide("timer.single-heartbeat", scenario);
  EXPECT_EQ(finding.kind, VerdictKind::violated);
  EXPECT_TRUE(mentions(finding, "after 2 steps"));
  EXPECT_TRUE(mentions(finding, "2. another reader: SuppressionEnds"));
}

TEST(SingleHeartbeat, AKnobOfTheMutantCounts) {
  checker::Mutant mutant;
  mutant.knobs = [](model::Scenario& scenario) {
    scenario.dds.sedp.heartbeat_timer = model::HeartbeatTimerKind::additive;
  };
  expect_violated("timer.single-heartbeat", paper(), mutant, "two HEARTBEAT expiries");
}

TEST(SingleHeartbeat, AnEventThatIsScheduledTwiceIsFound) {
  checker::Mutant mutant;
  mutant.rules.events.push_back(
      {EventKind::heartbeat_expiry, EventMutation::Change::duplicate, {}, {}});
  expect_violated("timer.single-heartbeat", paper(), mutant, "two HEARTBEAT expiries");
  mutant.rules.events.front().kind = EventKind::cycle_start;
  expect_violated("timer.single-heartbeat", adaptive(), mutant, "two cycle events");
}

TEST(SingleHeartbeat, AnArmingInTheWrongStateIsFound) {
  const char* const machine = "HeartbeatTimer";
  const std::size_t row = row_of(machine, "Idle", "ArmRequested", "Armed");
  expect_violated("timer.single-heartbeat", paper(),
                  with_row(machine, row, Kind::copy_row, state_of(machine, "Armed"),
                           state_of(machine, "Armed")),
                  "WriterSideOpens");
}

TEST(SecondOpinion, BothSolversSeeEveryPropertyAndItsExport) {
  if (smt::second_solver_name().empty()) GTEST_SKIP() << "cvc5 is not installed";
  const files::Folder own;
  const std::filesystem::path& folder = own.path();
  for (const std::string_view property : decidable()) {
    if (property == "live.recovery") continue;  // of amended rules: recovery_certificate_test.cpp
    const Finding finding = decide(property, paper(), nullptr, {.export_dir = folder.string()});
    EXPECT_EQ(finding.kind, VerdictKind::proved) << property << ": " << finding.how;
    if (property == "composition.total") continue;  // it needs no solver
    EXPECT_NE(finding.solver.find(" + cvc5 "), std::string::npos);
    EXPECT_NE(finding.how.find("decided by z3 and cvc5"), std::string::npos);
    if (property == "live.no-stall") continue;  // it rests on certificates with their own names
    EXPECT_TRUE(std::filesystem::exists(folder / (std::string{property} + ".smt2")));
  }
}

TEST(SecondOpinion, ASolverThatDisagreesMakesItDisputed) {
  const smt::FakeSolver fake{"while true; do echo sat; done | head -8"};
  const Finding finding = decide("safety.ack-implies-received", paper(), nullptr, {});
  EXPECT_EQ(finding.kind, VerdictKind::disputed);
  EXPECT_TRUE(mentions(finding, "the solvers do not agree"));
}

TEST(Certificate, AnInvariantThatIsNoneIsDisputed) {
  const model::Scenario scenario = paper();
  smt::Claims claims{{.second_solver = false}};
  const checker::CheckRequest request{.scenario = scenario, .claims = claims, .on_progress = {}};
  Proof proof{"some.property", request};
  const Expr x = proof.context().bool_const("x");
  const TransitionSystem wrong{{x}, !x, {{"step", {}, !x, {!x}}}, x};
  EXPECT_FALSE(certify(proof, wrong, !x));  // a step reaches x
  EXPECT_EQ(proof.finish("").kind, VerdictKind::disputed);
}

/// A stranger has what is needed: the invariant, and one question for each step.
TEST(Safety, ItsCertificateIsExported) {
  const files::Folder own;
  const std::filesystem::path& folder = own.path();
  for (const char* const property : {"safety.ack-implies-received", "safety.repair-only-if-asked",
                                     "safety.snapshot", "timer.single-heartbeat"}) {
    for (const model::Scenario& scenario : {paper(), fastdds()}) {
      const smt::Options options{.export_dir = folder.string(), .second_solver = false};
      EXPECT_EQ(decide(property, scenario, nullptr, options).kind, VerdictKind::proved);
      const auto file = folder / "certificates" / (std::string{property} + ".smt2");
      z3::context context;
      std::istringstream answers{Z3_eval_smtlib2_string(context, files::content(file).c_str())};
      std::size_t count = 0;
      for (std::string line; std::getline(answers, line); ++count) EXPECT_EQ(line, "unsat");
      EXPECT_GT(count, 4U) << property;
    }
  }
}

TEST(Budget, ThatIsUsedUpIsInconclusiveAndNeverSomethingElse) {
  const smt::Options tiny{.budget = {.z3 = 1, .cvc5 = 1}, .second_solver = false};
  for (const std::string_view property : decidable()) {
    const Finding finding = decide(property, fastdds(), nullptr, tiny);
    EXPECT_NE(finding.kind, VerdictKind::violated) << property << ": " << finding.how;
    EXPECT_NE(finding.kind, VerdictKind::disputed) << property << ": " << finding.how;
  }
}

TEST(TimeOut, IsNeverAVerdictAboutTheProperty) {
  const smt::Options at_once{.timeout = std::chrono::milliseconds{1}, .second_solver = false};
  for (const std::string_view property : decidable()) {
    const Finding finding = decide(property, fastdds(), nullptr, at_once);
    EXPECT_NE(finding.kind, VerdictKind::violated) << property << ": " << finding.how;
  }
}

TEST(Check, IsSilentAboutWhatItCannotDecideAndStopsWhenAsked) {
  const model::Scenario scenario;
  smt::Claims claims{{.second_solver = false}};
  const std::string_view properties[] = {"live.completion", "order.total", "order.total"};
  const checker::CheckRequest request{.scenario = scenario, .claims = claims, .on_progress = {}};
  EXPECT_EQ(check(properties, request).size(), 2U);
  const checker::CheckRequest stopped{.scenario = scenario,
                                      .claims = claims,
                                      .on_progress = [](std::string_view) { return false; }};
  EXPECT_TRUE(check(properties, stopped).empty());
}

}  // namespace safety_test
}  // namespace stormproof::tables
