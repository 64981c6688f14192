// Which steps a stepper remembers: those of events of which the rows read nothing but truth values.
// That it does what the machine does, with what it remembers, is part of the law of each machine
// (tests/fsm/flyweight_law.hpp).
#include "fsm/stepper.hpp"

#include <gtest/gtest.h>

#include "fsm/channel.hpp"
#include "fsm/discovery_reader.hpp"
#include "fsm/single_shot.hpp"

namespace stormproof::fsm {

namespace {

TEST(Stepper, RemembersStepsOfEventsThatReadTruthValuesAlone) {
  EXPECT_TRUE((IsFinite<Channel, channel::DispatchDue>));
  EXPECT_TRUE((IsFinite<DiscoveryReader, discovery_reader::HeartbeatReceived>));
  EXPECT_TRUE((IsFinite<SingleShot, single_shot::Due>));
}

TEST(Stepper, RemembersNoneWhoseGuardsOrActionsReadNumbers) {
  EXPECT_FALSE((IsFinite<DiscoveryReader, discovery_reader::DataReceived>));
  EXPECT_FALSE((IsFinite<SingleShot, single_shot::Requested>));
}

TEST(Stepper, TakesNumbersAsTheyAreEachTime) {
  Stepper<SingleShot> stepper;
  for (const std::int64_t now : {5, 7}) {
    StateId state = Reflect<SingleShot>::id<single_shot::Idle>;
    EXPECT_EQ(stepper.step<single_shot::Requested>(state, {.now = now, .delay = 10}).next_at,
              now + 10);
  }
}

TEST(Stepper, AStateWithoutARowStaysAsItIs) {
  Stepper<SingleShot> stepper;
  StateId state = Reflect<SingleShot>::id<single_shot::Pending>;
  RowId row = 0;
  EXPECT_FALSE(stepper.step<single_shot::Requested>(state, {.now = 5, .delay = 10}, row).schedule);
  EXPECT_EQ(state, (Reflect<SingleShot>::id<single_shot::Pending>));
  EXPECT_EQ(row, no_row);
}

}  // namespace

}  // namespace stormproof::fsm
