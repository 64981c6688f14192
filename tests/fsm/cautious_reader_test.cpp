// Cyclone DDS's reader: what it says when, and when it says nothing; with the edges that no test
// vector reaches.
#include "fsm/cautious_reader.hpp"

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include "tests/fsm/flyweight_law.hpp"
#include "tests/fsm/step.hpp"
#include "tests/fsm/survey.hpp"

namespace stormproof::fsm {

namespace cautious_reader_test {

using namespace cautious_reader;
using M = CautiousReader;
using Input = Flyweight<M>::Input;
using Output = Flyweight<M>::Output;

/// It lacks sample 3 of 5, has asked for all of them, and may ask again from 2'000 on, by itself
/// from 9'000 on.
constexpr Input asked{.fresh = true,
                      .directed = false,
                      .by_delay = false,
                      .first_missing = 3,
                      .last = 5,
                      .asked_end = 6,
                      .base = 3,
                      .now = 1'000,
                      .quiet_until = 1'500,
                      .hush_until = 2'000,
                      .again_at = 9'000,
                      .preemptive_delay = 10,
                      .repeat_delay = 1'000,
                      .again_delay = 3'000};

template <class Change>
Input with(Change change) {
  Input input = asked;
  change(input);
  return input;
}
Input fresh_gap() {
  return with([](Input& in) { in.last = 6, in.first_missing = 6; });
}
Input late() {
  return with([](Input& in) { in.now = 2'000; });
}
Input complete() {
  return with([](Input& in) { in.first_missing = 6; });
}

const std::vector<Input>& inputs() {
  static const std::vector<Input> all = [] {
    std::vector<Input> list{asked,
                            fresh_gap(),
                            late(),
                            complete(),
                            with([](Input& in) { in.quiet_until = 0; }),
                            with([](Input& in) { in.now = 9'000; }),
                            with([](Input& in) { in.first_missing = 6, in.base = 6; })};
    const std::size_t count = list.size();
    for (const auto& change :
         {+[](Input& in) { in.fresh = false; }, +[](Input& in) { in.directed = true; },
          +[](Input& in) { in.by_delay = true; }}) {
      for (std::size_t k = 0; k < count; ++k) {
        list.push_back(list[k]);
        change(list.back());
      }
    }
    return list;
  }();
  return all;
}

Output request(const Input& input, bool delayed = false) {
  return {.reply = true,
          .request = true,
          .delayed = delayed,
          .move = true,
          .next_at = input.now + 3'000};
}

TEST(CautiousReader, OpensAndWaitsForAHeartbeat) {
  expect_step<M, Closed, Opened, Unheard>(asked, {.opened = true, .move = true, .next_at = 1'010});
}

TEST(CautiousReader, DropsWhatComesBeforeItIsOpen) {
  for (const Input& input : inputs()) {
    expect_ignored<M, Closed, HeartbeatReceived>(input);
    expect_ignored<M, Closed, DataReceived>(input);
  }
}

TEST(CautiousReader, DropsDataBeforeItHasSeenAHeartbeat) {
  for (const Input& input : inputs()) {
    expect_ignored<M, Unheard, DataReceived>(input);
    expect_step<M, Answered, DataReceived, Answered>(input, {.take_data = true});
    expect_step<M, Heard, DataReceived, Heard>(input, {.take_data = true});
    expect_step<M, Addressed, DataReceived, Addressed>(input, {.take_data = true});
  }
}

TEST(CautiousReader, AsksByItselfOnceASecondUntilAHeartbeatIsSeen) {
  for (const Input& input : inputs()) {
    expect_step<M, Unheard, TimerFired, Unheard>(
        input, {.preempt = true, .move = true, .next_at = input.now + 1'000});
  }
}

TEST(CautiousReader, AnswersANewGapAtOnce) {
  const Input input = fresh_gap();
  const Output now{.learn = true, .note = true, .move = true, .next_at = 1'000};
  expect_step<M, Unheard, HeartbeatReceived, Heard>(input, now);
  expect_step<M, Answered, HeartbeatReceived, Heard>(input, now);
  expect_step<M, Heard, TimerFired, Answered>(input, request(input));
}

TEST(CautiousReader, KeepsQuietAboutAGapThatItHasAskedFor) {
  const Input heard = with([](Input& in) { in.quiet_until = 1'000; });
  expect_step<M, Answered, HeartbeatReceived, Heard>(
      heard, {.learn = true, .note = true, .move = true, .next_at = 2'000});
  expect_step<M, Heard, TimerFired, Answered>(heard,
                                              {.reply = true, .move = true, .next_at = 2'000});
}

TEST(CautiousReader, SaysNothingTwice) {
  expect_step<M, Answered, HeartbeatReceived, Heard>(
      asked, {.learn = true, .note = true, .move = false, .next_at = 1'000});
  expect_ignored<M, Heard, TimerFired>(asked);
  const Input confirmed = with([](Input& in) { in.first_missing = in.base = 6; });
  expect_ignored<M, Heard, TimerFired>(confirmed);
}

TEST(CautiousReader, AcknowledgesProgressAtOnce) {
  const Input input = complete();
  expect_step<M, Answered, HeartbeatReceived, Heard>(
      input, {.learn = true, .note = true, .move = true, .next_at = 1'000});
  expect_step<M, Heard, TimerFired, Answered>(input, {.reply = true});
}

TEST(CautiousReader, AsksAgainWhenNackDelayIsOver) {
  const Input input = late();
  expect_step<M, Heard, TimerFired, Answered>(input, request(input, true));
}

TEST(CautiousReader, AHeartbeatForItAloneIsAnsweredAtOnce) {
  const Input directed = with([](Input& in) { in.directed = true; });
  expect_step<M, Answered, HeartbeatReceived, Addressed>(
      directed, {.learn = true, .note = true, .move = true, .next_at = 1'000});
  expect_step<M, Addressed, TimerFired, Answered>(asked, request(asked));
  // A later one for everybody does not take that back.
  expect_step<M, Addressed, HeartbeatReceived, Addressed>(
      asked, {.learn = true, .note = true, .move = true, .next_at = 1'000});
}

TEST(CautiousReader, UnlessItsLastRequestWasARepetition) {
  const Input repeated = with([](Input& in) {
    in.by_delay = true;
    in.quiet_until = 0;
  });
  expect_step<M, Addressed, TimerFired, Answered>(repeated,
                                                  {.reply = true, .move = true, .next_at = 2'000});
  const Input over = with([](Input& in) { in.by_delay = true, in.now = 2'000; });
  expect_step<M, Addressed, TimerFired, Answered>(over, request(over));
}

TEST(CautiousReader, AStaleHeartbeatOnlyAnnounces) {
  const Input stale = with([](Input& in) {
    in.fresh = false;
    in.directed = true;
  });
  expect_step<M, Unheard, HeartbeatReceived, Answered>(stale, {.learn = true});
  expect_step<M, Answered, HeartbeatReceived, Answered>(stale, {.learn = true});
  expect_step<M, Heard, HeartbeatReceived, Heard>(stale, {.learn = true});
  expect_step<M, Addressed, HeartbeatReceived, Addressed>(stale, {.learn = true});
}

TEST(CautiousReader, AsksByItselfAfterThreeSeconds) {
  expect_step<M, Answered, TimerFired, Answered>(late(), {.move = true, .next_at = 9'000});
  expect_step<M, Answered, TimerFired, Answered>(with([](Input& in) { in.now = 8'999; }),
                                                 {.move = true, .next_at = 9'000});
  const Input over = with([](Input& in) { in.now = 9'000; });
  expect_step<M, Answered, TimerFired, Answered>(over, request(over, true));
  // A gap that it has not asked for waits as long: there was no HEARTBEAT about it.
  expect_step<M, Answered, TimerFired, Answered>(fresh_gap(), {.move = true, .next_at = 9'000});
}

TEST(CautiousReader, WithoutAHeartbeatThereIsNothingElseToSay) {
  expect_ignored<M, Answered, TimerFired>(asked);
  expect_ignored<M, Answered, TimerFired>(complete());
}

RC_GTEST_PROP(CautiousReader, FlyweightEqualsObjectsOfTheirOwn, ()) {
  FlyweightLaw<M>::check(inputs());
}

}  // namespace cautious_reader_test

MachineSurvey survey_cautious_reader() {
  return Surveyor<CautiousReader>{cautious_reader_test::inputs()}.run();
}

}  // namespace stormproof::fsm
