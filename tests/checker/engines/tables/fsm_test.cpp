// The properties of the tables as such: proved on the tables as they are, and each of them notices
// a mistake of its kind.
#include "tests/checker/engines/tables/table_check.hpp"

namespace stormproof::tables {
namespace fsm_test {

using Kind = fsm::TableMutation::Kind;

TEST(Fsm, EveryTableIsDeterministicTotalAndReachable) {
  for (const char* const property : {"fsm.determinism", "fsm.totality", "fsm.reachability"}) {
    expect_proved(property, paper());
    expect_proved(property, fastdds());
  }
}

TEST(Fsm, EveryMachineIsReportedOn) {
  for (const char* const property : {"fsm.determinism", "fsm.totality", "fsm.reachability"}) {
    const Finding finding = decide(property, paper());
    for (const fsm::MachineInfo& machine : fsm::machines()) {
      EXPECT_TRUE(mentions(finding, std::string{machine.name} + ": ")) << property;
    }
  }
}

TEST(FsmDeterminism, ACopiedRowWithAnOverlappingGuardIsFound) {
  // R on ACKNACK to A, if confirmed; the copy lets U do the same and go to R.
  const char* const machine = "DescriptorRepair";
  const std::size_t row = row_of(machine, "R", "AckNackReceived", "A");
  const auto mutant =
      with_row(machine, row, Kind::copy_row, state_of(machine, "U"), state_of(machine, "R"));
  expect_violated("fsm.determinism", paper(), mutant, "listed = false");
}

TEST(FsmDeterminism, AnIgnoredGuardIsFound) {
  const std::size_t row = row_of("Announcer", "Starting", "AnnouncementDue", "Periodic");
  expect_violated("fsm.determinism", paper(), with_row("Announcer", row, Kind::ignore_guard),
                  "both fire with");
}

TEST(FsmDeterminism, ANegatedGuardIsFound) {
  const std::size_t row = row_of("InitialAckNack", "Waiting", "AttemptDue", "Done");
  expect_violated("fsm.determinism", paper(), with_row("InitialAckNack", row, Kind::negate_guard),
                  "heartbeat_seen = false");
}

TEST(FsmTotality, ADroppedRowIsFound) {
  const std::size_t row = row_of("ChangeForReader", "R", "NackResponseDue", "Q");
  expect_violated("fsm.totality", fastdds(), with_row("ChangeForReader", row, Kind::drop_row),
                  "ChangeForReader: R on NackResponseDue has no row and is not listed");
}

TEST(FsmTotality, AnIgnoredGuardMakesAnEntryStale) {
  const std::size_t row = row_of("Channel", "Idle", "DispatchDue", "Busy");
  expect_violated("fsm.totality", paper(), with_row("Channel", row, Kind::ignore_guard),
                  "listed as ignored on some input, but never is");
}

TEST(FsmTotality, ANewRowMakesAnEntryStale) {
  const char* const machine = "SingleShot";
  const std::size_t row = row_of(machine, "Idle", "Requested", "Pending");
  const auto mutant = with_row(machine, row, Kind::copy_row, state_of(machine, "Pending"),
                               state_of(machine, "Pending"));
  expect_violated("fsm.totality", paper(), mutant, "is listed as having no row, but has one");
}

TEST(FsmTotality, AGuardThatLeavesAGapIsFound) {
  const std::size_t row = row_of("InitialAckNack", "Dormant", "ReaderOpened", "Done");
  expect_violated("fsm.totality", paper(), with_row("InitialAckNack", row, Kind::negate_guard),
                  "first_delay = 0");
}

TEST(FsmReachability, AStateThatNothingLeadsToIsFound) {
  const std::size_t row = row_of("DescriptorRepair", "R", "RepairDue", "Q");
  const auto mutant = with_row("DescriptorRepair", row, Kind::drop_row);
  expect_violated("fsm.reachability", paper(), mutant, "state Q cannot be reached");
  expect_violated("fsm.reachability", paper(), mutant, "Q on RepairSent to S is dead");
}

TEST(FsmReachability, ARowWhoseGuardCannotHoldIsDead) {
  const std::size_t row = row_of("SingleShot", "Idle", "Requested", "Pending");
  expect_violated("fsm.reachability", paper(), with_row("SingleShot", row, Kind::negate_guard),
                  "is dead");
}

TEST(Fsm, AMistakeInATableThatDoesNotExistMakesNoProof) {
  const Finding finding = [] {
    const auto mutant = with_row("DescriptorRepair", 1000, Kind::drop_row);
    return decide("fsm.determinism", paper(), &mutant);
  }();
  EXPECT_EQ(finding.kind, VerdictKind::inconclusive);
  EXPECT_FALSE(finding.details.empty());
}

}  // namespace fsm_test
}  // namespace stormproof::tables
