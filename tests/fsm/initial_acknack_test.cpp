// The timer of the initial ACKNACK: every row once, the guards both ways, both kinds of intervals,
// and a delay of 0.
#include "fsm/initial_acknack.hpp"

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include "tests/fsm/flyweight_law.hpp"
#include "tests/fsm/step.hpp"
#include "tests/fsm/survey.hpp"

namespace stormproof::fsm {

namespace initial_acknack_test {

using namespace initial_acknack;
using M = InitialAckNack;
using Input = Flyweight<M>::Input;

const std::vector<Input>& inputs() {
  static const std::vector<Input> all = [] {
    std::vector<Input> list;
    for (const std::int64_t now : {0, 5}) {
      for (const std::int64_t first : {0, 1, 70}) {
        for (const bool seen : {false, true}) {
          for (const std::int64_t factor : {1, 2, 4}) {
            for (const bool constant : {false, true})
              list.push_back({now, first, first * factor, seen, constant});
          }
        }
      }
    }
    return list;
  }();
  return all;
}

TEST(InitialAckNack, OpeningStartsTheFirstDelay) {
  expect_step<M, Dormant, ReaderOpened, Waiting>(
      {.now = 1'000, .first_delay = 70, .last_delay = 70},
      {.schedule = true, .next_delay = 70, .next_at = 1'070});
}

TEST(InitialAckNack, ADelayOfZeroDisablesIt) {
  expect_step<M, Dormant, ReaderOpened, Done>({.now = 1'000, .first_delay = 0, .last_delay = 0});
}

TEST(InitialAckNack, TheShortestDelayDoesNotDisableIt) {
  expect_step<M, Dormant, ReaderOpened, Waiting>({.now = 0, .first_delay = 1, .last_delay = 1},
                                                 {.schedule = true, .next_delay = 1, .next_at = 1});
}

TEST(InitialAckNack, OpeningDoesNotLookAtHeartbeats) {
  expect_step<M, Dormant, ReaderOpened, Waiting>(
      {.now = 1, .first_delay = 2, .last_delay = 2, .heartbeat_seen = true},
      {.schedule = true, .next_delay = 2, .next_at = 3});
}

TEST(InitialAckNack, EachAttemptWaitsTwiceAsLongAsTheLastOne) {
  expect_step<M, Waiting, AttemptDue, Waiting>(
      {.now = 170, .first_delay = 70, .last_delay = 70},
      {.attempt = true, .schedule = true, .next_delay = 140, .next_at = 310});
  expect_step<M, Waiting, AttemptDue, Waiting>(
      {.now = 310, .first_delay = 70, .last_delay = 140},
      {.attempt = true, .schedule = true, .next_delay = 280, .next_at = 590});
}

TEST(InitialAckNack, EachAttemptWaitsAsLongAsTheLastOneIfTheIntervalIsConstant) {
  expect_step<M, Waiting, AttemptDue, Waiting>(
      {.now = 170, .first_delay = 70, .last_delay = 70, .constant = true},
      {.attempt = true, .schedule = true, .next_delay = 70, .next_at = 240});
  expect_step<M, Waiting, AttemptDue, Waiting>(
      {.now = 240, .first_delay = 70, .last_delay = 70, .constant = true},
      {.attempt = true, .schedule = true, .next_delay = 70, .next_at = 310});
}

TEST(InitialAckNack, TheFirstDelayIsTheSameWithEitherInterval) {
  expect_step<M, Dormant, ReaderOpened, Waiting>(
      {.now = 1'000, .first_delay = 70, .last_delay = 70, .constant = true},
      {.schedule = true, .next_delay = 70, .next_at = 1'070});
  expect_step<M, Dormant, ReaderOpened, Done>({.now = 1'000, .first_delay = 0, .constant = true});
}

TEST(InitialAckNack, AHeartbeatEndsIt) {
  for (const bool constant : {false, true}) {
    expect_step<M, Waiting, AttemptDue, Done>({.now = 170,
                                               .first_delay = 70,
                                               .last_delay = 70,
                                               .heartbeat_seen = true,
                                               .constant = constant});
  }
}

TEST(InitialAckNack, NothingHappensBeforeItStartsOrAfterItsEnd) {
  for (const Input& input : inputs()) {
    expect_ignored<M, Dormant, AttemptDue>(input);
    expect_ignored<M, Waiting, ReaderOpened>(input);
    expect_ignored<M, Done, AttemptDue>(input);
    expect_ignored<M, Done, ReaderOpened>(input);
  }
}

RC_GTEST_PROP(InitialAckNack, FlyweightEqualsObjectsOfTheirOwn, ()) {
  FlyweightLaw<M>::check(inputs());
}

}  // namespace initial_acknack_test

MachineSurvey survey_initial_acknack() {
  return Surveyor<InitialAckNack>{initial_acknack_test::inputs()}.run();
}

}  // namespace stormproof::fsm
