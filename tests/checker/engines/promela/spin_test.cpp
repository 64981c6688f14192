// SPIN verifies the models of both compositions, and finds the mistake in mutated ones:
// acknowledging what was not confirmed, a repair that never comes, a state that nothing leaves, an
// effect that a rule forgets.
#include <gtest/gtest.h>

#include "checker/engines/promela/promela.hpp"
#include "tests/checker/engines/promela/mistakes.hpp"
#include "tests/checker/engines/promela/run_in_test.hpp"

namespace stormproof::promela {
namespace spin_test {

using Kind = fsm::TableMutation::Kind;

class Spin : public SpinTest {};

/// The paper's default profile without initial ACKNACKs, which answer no question of these tests
/// that HEARTBEATs do not, and triple the states.
model::DdsProfile heartbeats_only() {
  model::DdsProfile dds;
  dds.sedp.initial_acknack_delay = model::Nanoseconds{0};
  return dds;
}
model::DdsProfile fastdds() {
  model::DdsProfile dds;
  dds.implementation = model::ImplementationKind::fastdds;
  return dds;
}
std::string repair_mutant(const std::vector<fsm::TableMutation>& tables) {
  return promela_of(1, heartbeats_only(), in_tables(tables));
}
std::string change_mutant(std::size_t row, Kind kind) {
  return promela_of(1, fastdds(), in_tables({{"ChangeForReader", row, kind, 0, 0}}));
}

TEST_F(Spin, VerifiesThePapersWriterWithOneDescriptor) {
  expect_correct(promela_of(1, {}), 15'000);
}
TEST_F(Spin, VerifiesThePapersWriterWithTwoDescriptors) {
  expect_correct(promela_of(2, heartbeats_only()), 500'000);
}
TEST_F(Spin, VerifiesThePapersWriterThatAcknowledgesAPrefix) {
  model::DdsProfile dds = heartbeats_only();
  dds.sedp.acknowledge = model::Acknowledge::prefix;
  dds.sedp.initial_data = model::InitialData::pull;
  expect_correct(promela_of(2, dds), 50'000);
}
TEST_F(Spin, VerifiesThePapersWriterWithThreeDescriptors) {
  model::DdsProfile dds;
  dds.sedp.initial_data = model::InitialData::pull;
  expect_correct(promela_of(3, dds), 1'000'000);
}
TEST_F(Spin, VerifiesTheWriterOfFastddsWithOneDescriptor) {
  expect_correct(promela_of(1, fastdds()), 30'000);
}

TEST_F(Spin, FindsADescriptorThatIsAcknowledgedWithoutConfirmation) {
  const char* const wrong = "safe_0: pan:1: assertion violated";
  expect_error(repair_mutant({{"DescriptorRepair", 4, Kind::ignore_guard, 0, 0}}), wrong);
  expect_error(repair_mutant({{"DescriptorRepair", 6, Kind::ignore_guard, 0, 0}}), wrong);
}

TEST_F(Spin, FindsARequestThatLeadsToNoRepair) {
  expect_error(repair_mutant({{"DescriptorRepair", 0, Kind::drop_action, 0, 0}}),
               "progress: pan:1: acceptance cycle");
}

TEST_F(Spin, FindsAStateThatNothingConfirms) {
  // S never ends and is never confirmed.
  expect_error(repair_mutant({{"DescriptorRepair", 3, Kind::drop_row, 0, 0},
                              {"DescriptorRepair", 7, Kind::drop_row, 0, 0}}),
               "progress: pan:1: acceptance cycle");
}

TEST_F(Spin, FindsMistakesInTheWriterOfFastdds) {
  expect_error(change_mutant(6, Kind::ignore_guard), "safe_0: pan:1: assertion violated");
  expect_error(change_mutant(3, Kind::drop_row), "progress: pan:1: acceptance cycle");
}

/// What is requested waits for a repair generation that is never pending, and a HEARTBEAT timer
/// that is not armed again sends a single HEARTBEAT, which may be lost.
TEST_F(Spin, FindsMistakesBetweenTheMachines) {
  const char* const wrong = "progress: pan:1: acceptance cycle";
  const auto paper = [](std::string_view effect, Change change) {
    return promela_of(1, heartbeats_only(), at_effect("paper", effect, change));
  };
  expect_error(paper("AckNackArrives.4", Change::drop), wrong);
  expect_error(paper("HeartbeatExpires.2", Change::drop), wrong);
  expect_error(promela_of(1, fastdds(), at_effect("fastdds", "NackResponds.3", Change::drop)),
               wrong);
}

/// A model with three descriptors has no claim of progress.
TEST_F(Spin, FindsARepairThatIsForgottenAsADeadlock) {
  model::DdsProfile dds = heartbeats_only();
  dds.sedp.initial_data = model::InitialData::pull;
  expect_error(promela_of(3, dds, at_effect("paper", "ClockGoesOn.2", Change::drop)),
               "no deadlock: pan:1: invalid end state");
}

TEST_F(Spin, FindsADeadlock) {
  expect_error("byte x; active proctype P() { x == 1 -> skip }\n",
               "no deadlock: pan:1: invalid end state");
}

TEST_F(Spin, SaysWhatIsWrongWithAModel) {
  const auto run = run_spin("this is no model", folder_.string());
  ASSERT_FALSE(run);
  EXPECT_EQ(run.error().substr(0, 23), "spin failed with status");
}

TEST_F(Spin, NeedsAFolderThatExists) {
  const auto run = run_spin("", (folder_ / "absent").string());
  ASSERT_FALSE(run);
  EXPECT_NE(run.error().find("no model can be written there"), std::string::npos);
}

}  // namespace spin_test
}  // namespace stormproof::promela
