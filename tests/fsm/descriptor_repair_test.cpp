// The repair state of one descriptor: every row once, the guards both ways, and what stays
// untouched.
#include "fsm/descriptor_repair.hpp"

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include "tests/fsm/flyweight_law.hpp"
#include "tests/fsm/step.hpp"
#include "tests/fsm/survey.hpp"

namespace stormproof::fsm {

namespace descriptor_repair_test {

using namespace descriptor_repair;
using M = DescriptorRepair;
using Input = Flyweight<M>::Input;

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

TEST(DescriptorRepair, StartsUnacknowledged) {
  EXPECT_EQ(Reflect<M>::state_names[Flyweight<M>::initial], "U");
}

TEST(DescriptorRepair, GoesRoundTheRepairCycle) {
  expect_step<M, U, AckNackReceived, R>(missing, {.requested = true});
  expect_step<M, R, RepairDue, Q>({}, {.generate = true});
  expect_step<M, Q, RepairSent, S>({});
  expect_step<M, S, SuppressionEnded, U>({}, {.returned = true});
}

TEST(DescriptorRepair, ConfirmationAcknowledgesFromAnyState) {
  expect_step<M, U, AckNackReceived, A>(clean, {});
  expect_step<M, R, AckNackReceived, A>(clean, {});
  expect_step<M, Q, AckNackReceived, A>(clean, {});
  expect_step<M, S, AckNackReceived, A>(clean, {});
}

TEST(DescriptorRepair, ASecondRequestAddsNothing) {
  expect_ignored<M, R, AckNackReceived>(missing);
  expect_ignored<M, Q, AckNackReceived>(missing);
  expect_ignored<M, S, AckNackReceived>(missing);
}

TEST(DescriptorRepair, WithThePrefixRuleOnlyWhatIsBelowTheFirstMissingIsConfirmed) {
  constexpr Input below{.listed = false, .below_first_missing = true, .prefix_only = true};
  constexpr Input above{.listed = false, .below_first_missing = false, .prefix_only = true};
  expect_step<M, U, AckNackReceived, A>(below, {});
  expect_step<M, S, AckNackReceived, A>(below, {});
  expect_ignored<M, U, AckNackReceived>(above);
  expect_ignored<M, R, AckNackReceived>(above);
  expect_ignored<M, Q, AckNackReceived>(above);
  expect_ignored<M, S, AckNackReceived>(above);
}

TEST(DescriptorRepair, AListedDescriptorIsRequestedUnderBothRules) {
  expect_step<M, U, AckNackReceived, R>({.listed = true, .prefix_only = true}, {.requested = true});
  expect_step<M, U, AckNackReceived, R>(
      {.listed = true, .below_first_missing = true, .prefix_only = true}, {.requested = true});
}

TEST(DescriptorRepair, AcknowledgmentIsFinal) {
  for (const Input& input : inputs()) {
    expect_ignored<M, A, AckNackReceived>(input);
    expect_ignored<M, A, RepairDue>(input);
    expect_ignored<M, A, RepairSent>(input);
    expect_ignored<M, A, SuppressionEnded>(input);
  }
}

TEST(DescriptorRepair, EventsOfOtherDescriptorsLeaveItAlone) {
  expect_ignored<M, U, RepairDue>({});
  expect_ignored<M, U, SuppressionEnded>({});
  expect_ignored<M, R, SuppressionEnded>({});
  expect_ignored<M, Q, RepairDue>({});
  expect_ignored<M, Q, SuppressionEnded>({});
  expect_ignored<M, S, RepairDue>({});
}

RC_GTEST_PROP(DescriptorRepair, FlyweightEqualsObjectsOfTheirOwn, ()) {
  FlyweightLaw<M>::check(inputs());
}

}  // namespace descriptor_repair_test

MachineSurvey survey_descriptor_repair() {
  return Surveyor<DescriptorRepair>{descriptor_repair_test::inputs()}.run();
}

}  // namespace stormproof::fsm
