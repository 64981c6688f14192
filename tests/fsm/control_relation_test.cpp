// The two sides of a control-only relation: every row, and what a closed side drops.
#include "fsm/control_relation.hpp"

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include "tests/fsm/flyweight_law.hpp"
#include "tests/fsm/step.hpp"
#include "tests/fsm/survey.hpp"

namespace stormproof::fsm {

namespace control_relation_test {

using namespace control_relation;
using Input = Flyweight<ControlWriter>::Input;

// These machines have no input: one value is all there is. It is listed twice, because a survey
// takes a single input for a mistake.
const std::vector<Input>& inputs() {
  static const std::vector<Input> all(2);
  return all;
}

TEST(ControlWriter, OpensOnceWithAHeartbeat) {
  EXPECT_EQ(Reflect<ControlWriter>::state_names[Flyweight<ControlWriter>::initial], "Closed");
  expect_step<ControlWriter, Closed, Opened, Open>({}, {.send_heartbeat = true});
  expect_ignored<ControlWriter, Open, Opened>({});
}

TEST(ControlWriter, AnswersAnInitialAckNackWithAHeartbeatWheneverItComes) {
  expect_step<ControlWriter, Open, InitialAckNackReceived, Open>({}, {.send_heartbeat = true});
}

TEST(ControlWriter, IgnoresAnInitialAckNackWhileItIsClosed) {
  expect_ignored<ControlWriter, Closed, InitialAckNackReceived>({});
}

TEST(ControlReader, OpensOnceAndStartsTheInitialAckNackTimer) {
  EXPECT_EQ(Reflect<ControlReader>::state_names[Flyweight<ControlReader>::initial], "Closed");
  expect_step<ControlReader, Closed, Opened, Open>({}, {.start_initial = true});
  expect_ignored<ControlReader, Open, Opened>({});
}

TEST(ControlReader, RepliesToEveryHeartbeat) {
  expect_step<ControlReader, Open, HeartbeatReceived, Open>({}, {.reply = true});
}

TEST(ControlReader, DropsAHeartbeatWhileItIsClosed) {
  expect_ignored<ControlReader, Closed, HeartbeatReceived>({});
}

RC_GTEST_PROP(ControlWriter, FlyweightEqualsObjectsOfTheirOwn, ()) {
  FlyweightLaw<ControlWriter>::check(inputs());
}

RC_GTEST_PROP(ControlReader, FlyweightEqualsObjectsOfTheirOwn, ()) {
  FlyweightLaw<ControlReader>::check(inputs());
}

}  // namespace control_relation_test

MachineSurvey survey_control_writer() {
  return Surveyor<ControlWriter>{control_relation_test::inputs()}.run();
}
MachineSurvey survey_control_reader() {
  return Surveyor<ControlReader>{control_relation_test::inputs()}.run();
}

}  // namespace stormproof::fsm
