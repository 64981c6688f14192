// The channel: every row once, the guards both ways.
#include "fsm/channel.hpp"

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include "tests/fsm/flyweight_law.hpp"
#include "tests/fsm/step.hpp"
#include "tests/fsm/survey.hpp"

namespace stormproof::fsm {

namespace channel_test {

using namespace channel;
using M = Channel;
using Input = Flyweight<M>::Input;

const std::vector<Input>& inputs() {
  static const std::vector<Input> all{{false, false}, {false, true}, {true, false}, {true, true}};
  return all;
}

constexpr Input nothing{.waiting = false, .dispatch_pending = false};
constexpr Input some{.waiting = true, .dispatch_pending = false};
constexpr Input some_and_dispatch{.waiting = true, .dispatch_pending = true};
constexpr Input dispatch_only{.waiting = false, .dispatch_pending = true};

TEST(Channel, StartsIdle) { EXPECT_EQ(Reflect<M>::state_names[Flyweight<M>::initial], "Idle"); }

TEST(Channel, ARequestSchedulesOneDispatchPerInstant) {
  expect_step<M, Idle, ServiceRequested, Idle>(some, {.schedule_dispatch = true});
  expect_ignored<M, Idle, ServiceRequested>(some_and_dispatch);
  expect_ignored<M, Busy, ServiceRequested>(some);
}

TEST(Channel, ADispatchServesIfSomethingWaits) {
  expect_step<M, Idle, DispatchDue, Busy>(some, {.serve = true});
  expect_ignored<M, Idle, DispatchDue>(nothing);
  expect_ignored<M, Busy, DispatchDue>(some);
}

TEST(Channel, TheEndOfAServiceMakesItIdle) {
  for (const Input& input : inputs()) expect_step<M, Busy, ServiceFinished, Idle>(input);
}

TEST(Channel, AfterTheEffectsOfAServiceItLooksForWork) {
  expect_step<M, Idle, EffectsDone, Idle>(some, {.schedule_dispatch = true});
  expect_ignored<M, Idle, EffectsDone>(some_and_dispatch);
  expect_ignored<M, Idle, EffectsDone>(dispatch_only);
  expect_ignored<M, Idle, EffectsDone>(nothing);
  expect_ignored<M, Busy, EffectsDone>(some);
}

RC_GTEST_PROP(Channel, FlyweightEqualsObjectsOfTheirOwn, ()) { FlyweightLaw<M>::check(inputs()); }

}  // namespace channel_test

MachineSurvey survey_channel() { return Surveyor<Channel>{channel_test::inputs()}.run(); }

}  // namespace stormproof::fsm
