// Fast DDS's view of one descriptor towards one reader: every row once, the guards both ways, and
// what stays untouched.
#include "fsm/change_for_reader.hpp"

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include "tests/fsm/flyweight_law.hpp"
#include "tests/fsm/step.hpp"
#include "tests/fsm/survey.hpp"

namespace stormproof::fsm {

namespace change_for_reader_test {

using namespace change_for_reader;
using M = ChangeForReader;
using Input = Flyweight<M>::Input;

const std::vector<Input>& inputs() {
  static const std::vector<Input> all{{false, false}, {false, true}, {true, false}, {true, true}};
  return all;
}

constexpr Input listed{.listed = true};
constexpr Input below_base{.below_base = true};
constexpr Input neither{};

TEST(ChangeForReader, StartsAbsent) {
  EXPECT_EQ(Reflect<M>::state_names[Flyweight<M>::initial], "Absent");
}

TEST(ChangeForReader, WhatExistsAtTheMatchIsPulledAndWhatComesLaterIsPushed) {
  expect_step<M, Absent, ReaderMatched, U>({});
  expect_step<M, Absent, Created, Q>({});  // the caller delivers it at once: no queue
}

TEST(ChangeForReader, GoesRoundTheRepairCycle) {
  expect_step<M, U, AckNackReceived, R>(listed, {.requested = true});
  expect_step<M, R, NackResponseDue, Q>({}, {.enqueue = true});
  expect_step<M, Q, Serialized, S>({});
  expect_step<M, S, SuppressionEnded, U>({});
}

TEST(ChangeForReader, TheBaseAcknowledgesFromAnyStateQueuedAndSuppressedToo) {
  expect_step<M, U, AckNackReceived, A>(below_base);
  expect_step<M, R, AckNackReceived, A>(below_base);
  expect_step<M, Q, AckNackReceived, A>(below_base);
  expect_step<M, S, AckNackReceived, A>(below_base);
}

TEST(ChangeForReader, TheBaseCountsMoreThanTheBitmap) {
  constexpr Input both{.listed = true, .below_base = true};
  expect_step<M, U, AckNackReceived, A>(both);
  expect_step<M, S, AckNackReceived, A>(both);
}

TEST(ChangeForReader, ASecondRequestAddsNothing) {
  expect_ignored<M, R, AckNackReceived>(listed);
  expect_ignored<M, Q, AckNackReceived>(listed);
  expect_ignored<M, S, AckNackReceived>(listed);
}

TEST(ChangeForReader, WhatIsNeitherListedNorBelowTheBaseStaysAsItIs) {
  expect_ignored<M, U, AckNackReceived>(neither);
  expect_ignored<M, R, AckNackReceived>(neither);
  expect_ignored<M, Q, AckNackReceived>(neither);
  expect_ignored<M, S, AckNackReceived>(neither);
}

TEST(ChangeForReader, AnInitialAckNackTakesTheAcknowledgmentBack) {
  expect_step<M, A, InitialAckNackReceived, U>({});
}

TEST(ChangeForReader, AnInitialAckNackLeavesEverythingElseAlone) {
  expect_ignored<M, Absent, InitialAckNackReceived>({});
  expect_ignored<M, U, InitialAckNackReceived>({});
  expect_ignored<M, R, InitialAckNackReceived>({});
  expect_ignored<M, Q, InitialAckNackReceived>({});
  expect_ignored<M, S, InitialAckNackReceived>({});
}

TEST(ChangeForReader, NoOtherEventMovesWhatIsAcknowledged) {
  for (const Input& input : inputs()) {
    expect_ignored<M, A, AckNackReceived>(input);
    expect_ignored<M, A, NackResponseDue>(input);
    expect_ignored<M, A, Serialized>(input);
    expect_ignored<M, A, SuppressionEnded>(input);
  }
}

TEST(ChangeForReader, EventsOfOtherDescriptorsLeaveItAlone) {
  expect_ignored<M, Absent, NackResponseDue>({});
  expect_ignored<M, Absent, SuppressionEnded>({});
  expect_ignored<M, U, NackResponseDue>({});
  expect_ignored<M, U, SuppressionEnded>({});
  expect_ignored<M, R, SuppressionEnded>({});
  expect_ignored<M, Q, NackResponseDue>({});
  expect_ignored<M, Q, SuppressionEnded>({});
  expect_ignored<M, S, NackResponseDue>({});
}

RC_GTEST_PROP(ChangeForReader, FlyweightEqualsObjectsOfTheirOwn, ()) {
  FlyweightLaw<M>::check(inputs());
}

}  // namespace change_for_reader_test

MachineSurvey survey_change_for_reader() {
  return Surveyor<ChangeForReader>{change_for_reader_test::inputs()}.run();
}

}  // namespace stormproof::fsm
