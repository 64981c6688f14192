// When a Cyclone DDS writer sends HEARTBEATs: every row, and the interval, whose doubling no test
// vector reaches.
#include "fsm/heartbeat_pacer.hpp"

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include "tests/fsm/flyweight_law.hpp"
#include "tests/fsm/step.hpp"
#include "tests/fsm/survey.hpp"

namespace stormproof::fsm {

namespace heartbeat_pacer_test {

using namespace heartbeat_pacer;
using M = HeartbeatPacer;
using Input = Flyweight<M>::Input;

constexpr Input waiting{.waiting = true,
                        .sent_before = true,
                        .now = 1'000,
                        .last_sent = 900,
                        .number = 0,
                        .interval = 100,
                        .interval_max = 8'000,
                        .match_delay = 1};

template <class Change>
Input with(Change change) {
  Input input = waiting;
  change(input);
  return input;
}

const std::vector<Input>& inputs() {
  static const std::vector<Input> all{waiting, with([](Input& in) { in.waiting = false; }),
                                      with([](Input& in) { in.last_sent = 901; }),
                                      with([](Input& in) { in.number = 7; }), with([](Input& in) {
                                        in.last_sent = 999;
                                        in.sent_before = false;
                                      })};
  return all;
}

std::int64_t interval(std::int64_t number, std::int64_t first = 100, std::int64_t most = 8'000) {
  Input input = waiting;
  input.interval = first;
  input.interval_max = most;
  return interval_after<Plain>(input, number);
}

TEST(HeartbeatPacer, TheIntervalDoublesWithEverySecondHeartbeatBeyondTheFifth) {
  for (std::int64_t n = 0; n <= 6; ++n) EXPECT_EQ(interval(n), 100) << n;
  EXPECT_EQ(interval(7), 200);
  EXPECT_EQ(interval(8), 200);
  EXPECT_EQ(interval(9), 400);
  EXPECT_EQ(interval(10), 400);
  EXPECT_EQ(interval(11), 800);
  EXPECT_EQ(interval(13), 1'600);
  EXPECT_EQ(interval(15), 3'200);
}

TEST(HeartbeatPacer, TheIntervalStaysBelowItsMaximum) {
  EXPECT_EQ(interval(17), 6'400);
  EXPECT_EQ(interval(19), 6'400);
  EXPECT_EQ(interval(1'000'000), 6'400);
  EXPECT_EQ(interval(7, 100, 200), 100);  // 200 would not be below
  EXPECT_EQ(interval(7, 100, 201), 200);
  EXPECT_EQ(interval(50, 9'000, 8'000), 9'000);
  EXPECT_EQ(interval(1'000'000, 1, 8'000'000'000), std::int64_t{1} << 32);
}

TEST(HeartbeatPacer, SendsWhenTheIntervalIsOver) {
  expect_step<M, Pacing, Fired, Pacing>(waiting, {.send = true, .move = true, .next_at = 1'100});
  expect_step<M, Pacing, Fired, Pacing>(with([](Input& in) { in.last_sent = 901; }),
                                        {.move = true, .next_at = 1'100});
}

TEST(HeartbeatPacer, TheNextIntervalCountsTheHeartbeatThatIsSent) {
  const Input seventh = with([](Input& in) { in.number = 6; });
  expect_step<M, Pacing, Fired, Pacing>(seventh, {.send = true, .move = true, .next_at = 1'200});
}

TEST(HeartbeatPacer, TheFirstOneWaitsForNothing) {
  const Input first = with([](Input& in) {
    in.last_sent = 999;
    in.sent_before = false;
  });
  expect_step<M, Pacing, Fired, Pacing>(first, {.send = true, .move = true, .next_at = 1'100});
}

TEST(HeartbeatPacer, RestsWhenNobodyWaits) {
  expect_step<M, Pacing, Fired, Resting>(with([](Input& in) { in.waiting = false; }));
}

TEST(HeartbeatPacer, AMatchASampleAndARepairBeginAnew) {
  for (const Input& input : inputs()) {
    expect_step<M, Resting, Matched, Pacing>(input,
                                             {.restart = true, .move = true, .next_at = 1'001});
    expect_step<M, Pacing, Matched, Pacing>(input,
                                            {.restart = true, .move = true, .next_at = 1'001});
    expect_step<M, Resting, Hastened, Pacing>(input,
                                              {.restart = true, .move = true, .next_at = 1'100});
    expect_step<M, Pacing, Hastened, Pacing>(input,
                                             {.restart = true, .move = true, .next_at = 1'100});
  }
}

RC_GTEST_PROP(HeartbeatPacer, FlyweightEqualsObjectsOfTheirOwn, ()) {
  FlyweightLaw<M>::check(inputs());
}

}  // namespace heartbeat_pacer_test

MachineSurvey survey_heartbeat_pacer() {
  return Surveyor<HeartbeatPacer>{heartbeat_pacer_test::inputs()}.run();
}

}  // namespace stormproof::fsm
