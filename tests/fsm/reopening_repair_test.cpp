// The repair state of a descriptor whose reader may forget: the paper's rows, and the two ways out
// of A.
#include "fsm/reopening_repair.hpp"

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include "tests/fsm/flyweight_law.hpp"
#include "tests/fsm/step.hpp"
#include "tests/fsm/survey.hpp"

namespace stormproof::fsm {

namespace reopening_repair_test {

using namespace descriptor_repair;
using M = ReopeningRepair;
using Input = Flyweight<M>::Input;
using Forgot = reopening_repair::ReaderForgot;
using Again = reopening_repair::RequestedAgain;

const std::vector<Input>& inputs() {
  static const std::vector<Input> all = [] {
    std::vector<Input> list;
    for (const bool listed : {false, true}) {
      for (const bool below : {false, true}) {
        for (const bool prefix : {false, true}) list.push_back({listed, below, prefix});
      }
    }
    return list;
  }();
  return all;
}

constexpr Input missing{.listed = true};
constexpr Input clean{.listed = false};

TEST(ReopeningRepair, HasTheRowsOfTheMachineThatItExtends) {
  const MachineInfo usual = Reflect<DescriptorRepair>::info();
  const MachineInfo reopening = Reflect<M>::info();
  EXPECT_EQ(reopening.states, usual.states);
  ASSERT_EQ(reopening.rows.size(), usual.rows.size() + 2);
  for (std::size_t k = 0; k < usual.rows.size(); ++k) {
    EXPECT_EQ(reopening.rows[k].source, usual.rows[k].source);
    EXPECT_EQ(reopening.rows[k].target, usual.rows[k].target);
    EXPECT_EQ(reopening.rows[k].guard, usual.rows[k].guard);
    EXPECT_EQ(reopening.rows[k].action, usual.rows[k].action);
  }
}

TEST(ReopeningRepair, GoesRoundTheRepairCycle) {
  expect_step<M, U, AckNackReceived, R>(missing, {.requested = true});
  expect_step<M, R, RepairDue, Q>({}, {.generate = true});
  expect_step<M, Q, RepairSent, S>({});
  expect_step<M, S, SuppressionEnded, U>({}, {.returned = true});
  expect_step<M, U, AckNackReceived, A>(clean, {});
  expect_step<M, R, AckNackReceived, A>(clean, {});
  expect_step<M, Q, AckNackReceived, A>(clean, {});
  expect_step<M, S, AckNackReceived, A>(clean, {});
}

TEST(ReopeningRepair, TakesAcknowledgmentsBackInTwoWays) {
  for (const Input& input : inputs()) {
    expect_step<M, A, Forgot, U>(input, {});
    expect_step<M, A, Again, R>(input, {.requested = true});
    expect_ignored<M, A, AckNackReceived>(input);
  }
}

TEST(ReopeningRepair, LeavesWhatIsNotAcknowledgedAlone) {
  for (const Input& input : inputs()) {
    expect_ignored<M, U, Forgot>(input);
    expect_ignored<M, R, Forgot>(input);
    expect_ignored<M, Q, Forgot>(input);
    expect_ignored<M, S, Forgot>(input);
    expect_ignored<M, U, Again>(input);
    expect_ignored<M, R, Again>(input);
    expect_ignored<M, Q, Again>(input);
    expect_ignored<M, S, Again>(input);
  }
}

RC_GTEST_PROP(ReopeningRepair, FlyweightEqualsObjectsOfTheirOwn, ()) {
  FlyweightLaw<M>::check(inputs());
}

}  // namespace reopening_repair_test

MachineSurvey survey_reopening_repair() {
  return Surveyor<ReopeningRepair>{reopening_repair_test::inputs()}.run();
}

}  // namespace stormproof::fsm
