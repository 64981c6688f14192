// The event thread: one run at a time, and a pause after each copy.
#include "fsm/event_thread.hpp"

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include "tests/fsm/flyweight_law.hpp"
#include "tests/fsm/step.hpp"
#include "tests/fsm/survey.hpp"

namespace stormproof::fsm {

namespace event_thread_test {

using namespace event_thread;
using M = EventThread;
using Input = Flyweight<M>::Input;

const std::vector<Input>& inputs() {
  static const std::vector<Input> all{{0, 0}, {5, 0}, {5, 20}};
  return all;
}

TEST(EventThread, RunsNowWhenItIsWoken) {
  expect_step<M, Asleep, Woken, Expected>({.now = 5, .send_time = 20},
                                          {.schedule = true, .next_at = 5});
}

TEST(EventThread, IsWokenOnce) {
  for (const Input& input : inputs()) {
    expect_ignored<M, Expected, Woken>(input);
    expect_ignored<M, Working, Woken>(input);
  }
}

TEST(EventThread, WorksWhenItsRunIsDue) {
  for (const Input& input : inputs()) {
    expect_step<M, Expected, RunDue, Working>(input, {.work = true});
  }
}

TEST(EventThread, GoesOnAfterTheSendTime) {
  expect_step<M, Working, CopySent, Expected>({.now = 5, .send_time = 20},
                                              {.schedule = true, .next_at = 25});
}

TEST(EventThread, SleepsWhenNothingIsLeft) {
  for (const Input& input : inputs()) expect_step<M, Working, NothingLeft, Asleep>(input);
}

RC_GTEST_PROP(EventThread, FlyweightEqualsObjectsOfTheirOwn, ()) {
  FlyweightLaw<M>::check(inputs());
}

}  // namespace event_thread_test

MachineSurvey survey_event_thread() {
  return Surveyor<EventThread>{event_thread_test::inputs()}.run();
}

}  // namespace stormproof::fsm
