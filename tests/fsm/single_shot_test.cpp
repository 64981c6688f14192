// The timer that is pending at most once: both rows, and that asking again moves nothing.
#include "fsm/single_shot.hpp"

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include "tests/fsm/flyweight_law.hpp"
#include "tests/fsm/step.hpp"
#include "tests/fsm/survey.hpp"

namespace stormproof::fsm {

namespace single_shot_test {

using namespace single_shot;
using M = SingleShot;
using Input = Flyweight<M>::Input;

const std::vector<Input>& inputs() {
  static const std::vector<Input> all{{0, 0}, {0, 10}, {7, 0}, {7, 10}};
  return all;
}

TEST(SingleShot, StartsIdle) { EXPECT_EQ(Reflect<M>::state_names[Flyweight<M>::initial], "Idle"); }

TEST(SingleShot, ARequestIsDueAfterTheDelay) {
  expect_step<M, Idle, Requested, Pending>({.now = 1'000, .delay = 10},
                                           {.schedule = true, .next_at = 1'010});
}

TEST(SingleShot, ADelayOfZeroIsScheduledToo) {
  expect_step<M, Idle, Requested, Pending>({.now = 1'000, .delay = 0},
                                           {.schedule = true, .next_at = 1'000});
}

TEST(SingleShot, FiresAndIsIdleAgain) {
  for (const Input& input : inputs()) expect_step<M, Pending, Due, Idle>(input, {.fire = true});
}

TEST(SingleShot, AskingAgainWhileItIsPendingChangesNothing) {
  for (const Input& input : inputs()) expect_ignored<M, Pending, Requested>(input);
}

TEST(SingleShot, AnIdleTimerNeverFires) {
  for (const Input& input : inputs()) expect_ignored<M, Idle, Due>(input);
}

TEST(SingleShot, TheFirstOfSeveralRequestsDecidesTheTime) {
  Flyweight<M> engine;
  StateId state = Flyweight<M>::initial;
  std::vector<std::int64_t> scheduled;
  for (const std::int64_t now : {100, 103, 109}) {
    Flyweight<M>::Output output{};
    state = engine.step<Requested>(state, {.now = now, .delay = 10}, output);
    if (output.schedule) scheduled.push_back(output.next_at);
  }
  EXPECT_EQ(scheduled, std::vector<std::int64_t>{110});
}

RC_GTEST_PROP(SingleShot, FlyweightEqualsObjectsOfTheirOwn, ()) {
  FlyweightLaw<M>::check(inputs());
}

}  // namespace single_shot_test

MachineSurvey survey_single_shot() {
  return Surveyor<SingleShot>{single_shot_test::inputs()}.run();
}

}  // namespace stormproof::fsm
