// A reader as its writer sees it: what makes it one that has replied.
#include "fsm/matched_reader.hpp"

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include "tests/fsm/flyweight_law.hpp"
#include "tests/fsm/step.hpp"
#include "tests/fsm/survey.hpp"

namespace stormproof::fsm {

namespace matched_reader_test {

using namespace matched_reader;
using M = MatchedReader;
using Input = Flyweight<M>::Input;

const std::vector<Input>& inputs() {
  static const std::vector<Input> all{{false, false}, {false, true}, {true, false}, {true, true}};
  return all;
}

TEST(MatchedReader, IsMatchedOnce) {
  for (const Input& input : inputs()) {
    expect_step<M, Unmatched, Opened, Silent>(input, {.matched = true});
    expect_ignored<M, Silent, Opened>(input);
    expect_ignored<M, Replied, Opened>(input);
    expect_ignored<M, Unmatched, AckNackReceived>(input);
  }
}

TEST(MatchedReader, HasRepliedForGood) {
  expect_step<M, Silent, AckNackReceived, Replied>({.accepted = true, .replies = true},
                                                   {.take = true});
  expect_step<M, Silent, AckNackReceived, Silent>({.accepted = true, .replies = false},
                                                  {.take = true});
  for (const bool replies : {false, true}) {
    expect_step<M, Replied, AckNackReceived, Replied>({.accepted = true, .replies = replies},
                                                      {.take = true});
  }
}

TEST(MatchedReader, WhatIsNotAcceptedChangesNothing) {
  for (const bool replies : {false, true}) {
    expect_ignored<M, Silent, AckNackReceived>({.accepted = false, .replies = replies});
    expect_ignored<M, Replied, AckNackReceived>({.accepted = false, .replies = replies});
  }
}

RC_GTEST_PROP(MatchedReader, FlyweightEqualsObjectsOfTheirOwn, ()) {
  FlyweightLaw<M>::check(inputs());
}

}  // namespace matched_reader_test

MachineSurvey survey_matched_reader() {
  return Surveyor<MatchedReader>{matched_reader_test::inputs()}.run();
}

}  // namespace stormproof::fsm
