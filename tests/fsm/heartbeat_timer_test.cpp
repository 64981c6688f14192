// The HEARTBEAT timer under both policies: every row once, the guards both ways, and the instants
// at which a response comes just in time and just too late.
#include "fsm/heartbeat_timer.hpp"

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include "tests/fsm/flyweight_law.hpp"
#include "tests/fsm/step.hpp"
#include "tests/fsm/survey.hpp"

namespace stormproof::fsm {

namespace heartbeat_timer_test {

using namespace heartbeat_timer;
using M = HeartbeatTimer;
using Input = Flyweight<M>::Input;

Input periodic(bool additive, bool unacknowledged, std::int64_t pending) {
  return {.now = 500,
          .heartbeat_period = 1'000,
          .adaptive = false,
          .additive = additive,
          .pending = pending,
          .unacknowledged = unacknowledged,
          .cycle = {}};
}

/// A cycle that started at 1,000 with T = 200 and contacted two readers; bounds 100 and 3,000.
Input adaptive(std::int64_t now, std::int64_t responded, bool unacknowledged = true) {
  Input input{.now = now,
              .heartbeat_period = 1'000,
              .adaptive = true,
              .additive = false,
              .pending = 0,
              .unacknowledged = unacknowledged,
              .cycle = {}};
  input.cycle.start = 1'000;
  input.cycle.period = 200;
  input.cycle.contacted = 2;
  input.cycle.responded = responded;
  input.cycle.min_period = 100;
  input.cycle.max_period = 3'000;
  return input;
}

const std::vector<Input>& inputs() {
  static const std::vector<Input> all = [] {
    std::vector<Input> list;
    for (const bool unacknowledged : {false, true}) {
      for (const bool additive : {false, true}) {
        for (const std::int64_t pending : {0, 1, 2}) {
          list.push_back(periodic(additive, unacknowledged, pending));
        }
      }
      for (const std::int64_t now : {1'000, 1'050, 1'199, 1'200, 1'201}) {
        for (const std::int64_t responded : {0, 1, 2}) {
          list.push_back(adaptive(now, responded, unacknowledged));
        }
      }
    }
    return list;
  }();
  return all;
}

TEST(HeartbeatTimerPeriodic, OpeningArmsAnIdleTimer) {
  expect_step<M, Idle, ArmRequested, Armed>(periodic(false, true, 0),
                                            {.schedule_expiry = true, .next_at = 1'500});
}

TEST(HeartbeatTimerPeriodic, OpeningNeverAddsAnExpiry) {
  expect_ignored<M, Armed, ArmRequested>(periodic(false, true, 1));
  expect_ignored<M, Armed, ArmRequested>(periodic(true, true, 1));
}

TEST(HeartbeatTimerPeriodic, TheEndOfASuppressionArmsAnIdleTimer) {
  expect_step<M, Idle, SuppressionEnded, Armed>(periodic(false, true, 0),
                                                {.schedule_expiry = true, .next_at = 1'500});
}

TEST(HeartbeatTimerPeriodic, TheEndOfASuppressionAddsAnExpiryOnlyToAnAdditiveTimer) {
  expect_ignored<M, Armed, SuppressionEnded>(periodic(false, true, 1));
  expect_step<M, Armed, SuppressionEnded, Armed>(periodic(true, true, 1),
                                                 {.schedule_expiry = true, .next_at = 1'500});
}

TEST(HeartbeatTimerPeriodic, AnExpirySendsAndGoesOnWhileSomethingIsUnacknowledged) {
  for (const std::int64_t pending : {0, 1}) {
    expect_step<M, Armed, Expired, Armed>(
        periodic(true, true, pending), {.send = true, .schedule_expiry = true, .next_at = 1'500});
  }
}

TEST(HeartbeatTimerPeriodic, WithEverythingAcknowledgedTheLastExpiryEndsIt) {
  expect_step<M, Armed, Expired, Armed>(periodic(true, false, 1));
  expect_step<M, Armed, Expired, Idle>(periodic(true, false, 0));
  expect_step<M, Armed, Expired, Idle>(periodic(false, false, 0));
}

TEST(HeartbeatTimerAdaptive, OpeningActivatesAnIdleTimerAndNoOther) {
  expect_step<M, Idle, ArmRequested, Pacing>(
      adaptive(1'000, 0), {.schedule_cycle = true, .next_at = 2'000, .period = 1'000});
  expect_ignored<M, Pacing, ArmRequested>(adaptive(1'000, 0));
  expect_ignored<M, Awaiting, ArmRequested>(adaptive(1'000, 0));
}

TEST(HeartbeatTimerAdaptive, TheEndOfASuppressionDoesNotArm) {
  expect_ignored<M, Idle, SuppressionEnded>(adaptive(1'000, 0));
  expect_ignored<M, Pacing, SuppressionEnded>(adaptive(1'000, 0));
  expect_ignored<M, Awaiting, SuppressionEnded>(adaptive(1'000, 0));
}

TEST(HeartbeatTimerAdaptive, ACycleContactsTheReadersAndEndsAfterOnePeriod) {
  expect_step<M, Pacing, CycleStarted, Awaiting>(
      adaptive(5'000, 0),
      {.send = true, .schedule_end = true, .invalidate = true, .next_at = 5'200});
}

TEST(HeartbeatTimerAdaptive, WithNobodyToContactItBecomesIdleAndForgetsItsPeriod) {
  expect_step<M, Pacing, CycleStarted, Idle>(adaptive(5'000, 0, false),
                                             {.invalidate = true, .period = 1'000});
}

TEST(HeartbeatTimerAdaptive, ACycleThatEndsStretchesThePeriodAndPacesTheSilentReaders) {
  expect_step<M, Awaiting, CycleEnded, Pacing>(  // one of two: T* = 400
      adaptive(1'200, 1),
      {.schedule_cycle = true, .pace = true, .invalidate = true, .next_at = 1'400, .period = 400});
}

TEST(HeartbeatTimerAdaptive, WithoutStretchingTheNextCycleStartsOneNanosecondLater) {
  expect_step<M, Awaiting, CycleEnded, Pacing>(  // both responded, but not in time to end it early
      adaptive(1'200, 2),
      {.schedule_cycle = true, .pace = true, .invalidate = true, .next_at = 1'201, .period = 200});
}

TEST(HeartbeatTimerAdaptive, ABatchIsSentAndChangesNothingElse) {
  expect_step<M, Pacing, BatchDue, Pacing>(adaptive(1'300, 1), {.send_batch = true});
}

TEST(HeartbeatTimerAdaptive, AResponseThatIsNotTheLastIsCounted) {
  expect_step<M, Awaiting, ResponseReceived, Awaiting>(adaptive(1'050, 0),
                                                       {.count_response = true});
  expect_step<M, Pacing, ResponseReceived, Pacing>(adaptive(1'050, 0), {.count_response = true});
}

TEST(HeartbeatTimerAdaptive, TheLastResponseInTimeEndsTheCycleEarly) {
  // 150 after the start: the next cycle starts now, and its period is 150.
  expect_step<M, Awaiting, ResponseReceived, Pacing>(adaptive(1'150, 1), {.schedule_cycle = true,
                                                                          .invalidate = true,
                                                                          .count_response = true,
                                                                          .next_at = 1'150,
                                                                          .period = 150});
  expect_step<M, Pacing, ResponseReceived, Pacing>(adaptive(1'150, 1), {.schedule_cycle = true,
                                                                        .invalidate = true,
                                                                        .count_response = true,
                                                                        .next_at = 1'150,
                                                                        .period = 150});
}

TEST(HeartbeatTimerAdaptive, AnEarlyEndKeepsTheShortestPeriod) {
  expect_step<M, Awaiting, ResponseReceived, Pacing>(adaptive(1'050, 1), {.schedule_cycle = true,
                                                                          .invalidate = true,
                                                                          .count_response = true,
                                                                          .next_at = 1'100,
                                                                          .period = 100});
}

TEST(HeartbeatTimerAdaptive, AtTheVeryEndOfThePeriodItIsTooLateForAnEarlyEnd) {
  expect_step<M, Awaiting, ResponseReceived, Pacing>(adaptive(1'199, 1), {.schedule_cycle = true,
                                                                          .invalidate = true,
                                                                          .count_response = true,
                                                                          .next_at = 1'199,
                                                                          .period = 199});
  expect_step<M, Awaiting, ResponseReceived, Awaiting>(adaptive(1'200, 1),
                                                       {.count_response = true});
  expect_step<M, Pacing, ResponseReceived, Pacing>(adaptive(1'200, 1), {.count_response = true});
}

TEST(HeartbeatTimerAdaptive, TheLastResponseWithNothingLeftToAskMakesItIdle) {
  expect_step<M, Awaiting, ResponseReceived, Idle>(
      adaptive(1'150, 1, false), {.invalidate = true, .count_response = true, .period = 1'000});
  expect_step<M, Pacing, ResponseReceived, Idle>(
      adaptive(1'150, 1, false), {.invalidate = true, .count_response = true, .period = 1'000});
}

RC_GTEST_PROP(HeartbeatTimer, FlyweightEqualsObjectsOfTheirOwn, ()) {
  FlyweightLaw<M>::check(inputs());
}

}  // namespace heartbeat_timer_test

MachineSurvey survey_heartbeat_timer() {
  return Surveyor<HeartbeatTimer>{heartbeat_timer_test::inputs()}.run();
}

}  // namespace stormproof::fsm
