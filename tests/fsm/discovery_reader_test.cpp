// The reader of one relation: every row once, the guards both ways.
#include "fsm/discovery_reader.hpp"

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include "tests/fsm/flyweight_law.hpp"
#include "tests/fsm/step.hpp"
#include "tests/fsm/survey.hpp"

namespace stormproof::fsm {

namespace discovery_reader_test {

using namespace discovery_reader;
using M = DiscoveryReader;
using Input = Flyweight<M>::Input;

const std::vector<Input>& inputs() {
  static const std::vector<Input> all = [] {
    std::vector<Input> list;
    for (const bool accepts : {false, true}) {
      for (const std::int64_t missing : {0, 1, 2, 100'000}) list.push_back({accepts, missing});
    }
    return list;
  }();
  return all;
}

constexpr Input drops_some{.accepts_unmatched = false, .missing_after = 3};
constexpr Input drops_last{.accepts_unmatched = false, .missing_after = 0};
constexpr Input accepts_some{.accepts_unmatched = true, .missing_after = 1};
constexpr Input accepts_last{.accepts_unmatched = true, .missing_after = 0};

TEST(DiscoveryReader, StartsUnknown) {
  EXPECT_EQ(Reflect<M>::state_names[Flyweight<M>::initial], "Unknown");
}

TEST(DiscoveryReader, TheAnnouncementOpensIt) {
  expect_step<M, Unknown, AnnouncementReceived, Recognised>(drops_some, {.opened = true});
  expect_step<M, EarlyComplete, AnnouncementReceived, Complete>(drops_last, {.opened = true});
}

TEST(DiscoveryReader, OpenItTakesDataUntilNothingIsMissing) {
  expect_step<M, Recognised, DataReceived, Recognised>(drops_some, {.take_data = true});
  expect_step<M, Recognised, DataReceived, Recognised>({.missing_after = 1}, {.take_data = true});
  expect_step<M, Recognised, DataReceived, Complete>(drops_last, {.take_data = true});
  expect_ignored<M, Complete, DataReceived>(accepts_last);
}

TEST(DiscoveryReader, NotOpenItTakesDataOnlyIfTheProfileSaysSo) {
  expect_step<M, Unknown, DataReceived, Unknown>(accepts_some, {.take_data = true});
  expect_step<M, Unknown, DataReceived, EarlyComplete>(accepts_last, {.take_data = true});
  expect_ignored<M, Unknown, DataReceived>(drops_some);
  expect_ignored<M, Unknown, DataReceived>(drops_last);
  expect_ignored<M, EarlyComplete, DataReceived>(accepts_last);
}

TEST(DiscoveryReader, NotOpenItAnswersHeartbeatsOnlyIfTheProfileSaysSo) {
  expect_step<M, Unknown, HeartbeatReceived, Unknown>(accepts_some, {.schedule_acknack = true});
  expect_step<M, EarlyComplete, HeartbeatReceived, EarlyComplete>(accepts_last,
                                                                  {.schedule_acknack = true});
  expect_ignored<M, Unknown, HeartbeatReceived>(drops_some);
  expect_ignored<M, EarlyComplete, HeartbeatReceived>(drops_last);
}

TEST(DiscoveryReader, OpenItAnswersEveryHeartbeat) {
  for (const Input& input : inputs()) {
    expect_step<M, Recognised, HeartbeatReceived, Recognised>(input, {.schedule_acknack = true});
    expect_step<M, Complete, HeartbeatReceived, Complete>(input, {.schedule_acknack = true});
  }
}

TEST(DiscoveryReader, ADueAckNackIsSentInEveryState) {
  for (const Input& input : inputs()) {
    expect_step<M, Unknown, AckNackDue, Unknown>(input, {.send_acknack = true});
    expect_step<M, EarlyComplete, AckNackDue, EarlyComplete>(input, {.send_acknack = true});
    expect_step<M, Recognised, AckNackDue, Recognised>(input, {.send_acknack = true});
    expect_step<M, Complete, AckNackDue, Complete>(input, {.send_acknack = true});
  }
}

TEST(DiscoveryReader, AnInitialAckNackIsSentOnceOpenEvenWhenComplete) {
  expect_step<M, Recognised, InitialAckNackDue, Recognised>(drops_some, {.send_initial = true});
  expect_step<M, Complete, InitialAckNackDue, Complete>(drops_last, {.send_initial = true});
}

RC_GTEST_PROP(DiscoveryReader, FlyweightEqualsObjectsOfTheirOwn, ()) {
  FlyweightLaw<M>::check(inputs());
}

}  // namespace discovery_reader_test

MachineSurvey survey_discovery_reader() {
  return Surveyor<DiscoveryReader>{discovery_reader_test::inputs()}.run();
}

}  // namespace stormproof::fsm
