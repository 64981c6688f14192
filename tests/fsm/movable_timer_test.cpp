// The timer that moves to earlier times only: every row, and which of its events find it due.
#include "fsm/movable_timer.hpp"

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include "tests/fsm/flyweight_law.hpp"
#include "tests/fsm/step.hpp"
#include "tests/fsm/survey.hpp"

namespace stormproof::fsm {

namespace movable_timer_test {

using namespace movable_timer;
using M = MovableTimer;
using Input = Flyweight<M>::Input;

const std::vector<Input>& inputs() {
  static const std::vector<Input> all{{5, 7, 6}, {5, 7, 7}, {5, 7, 8}, {7, 7, 9}, {8, 7, 8}};
  return all;
}

TEST(MovableTimer, AnyTimeIsEarlierThanNever) {
  for (const Input& input : inputs()) {
    expect_step<M, Idle, Moved, Scheduled>(input, {.schedule = true});
  }
}

TEST(MovableTimer, MovesToEarlierTimesOnly) {
  expect_step<M, Scheduled, Moved, Scheduled>({.now = 5, .due = 7, .to = 6}, {.schedule = true});
  expect_ignored<M, Scheduled, Moved>({.now = 5, .due = 7, .to = 7});
  expect_ignored<M, Scheduled, Moved>({.now = 5, .due = 7, .to = 8});
}

TEST(MovableTimer, JoinsTheListWhenItIsDue) {
  expect_step<M, Scheduled, Came, Listed>({.now = 7, .due = 7, .to = 0}, {.join = true});
  expect_ignored<M, Scheduled, Came>({.now = 5, .due = 7, .to = 0});
}

TEST(MovableTimer, IsOnTheListOnce) {
  for (const Input& input : inputs()) {
    expect_ignored<M, Listed, Came>(input);
    expect_ignored<M, Listed, Moved>(input);
    expect_ignored<M, Idle, Came>(input);
  }
}

TEST(MovableTimer, IsNeverDueOnceItIsTaken) {
  for (const Input& input : inputs()) expect_step<M, Listed, Taken, Idle>(input);
}

RC_GTEST_PROP(MovableTimer, FlyweightEqualsObjectsOfTheirOwn, ()) {
  FlyweightLaw<M>::check(inputs());
}

}  // namespace movable_timer_test

MachineSurvey survey_movable_timer() {
  return Surveyor<MovableTimer>{movable_timer_test::inputs()}.run();
}

}  // namespace stormproof::fsm
