// The announcement schedule: every row once, the guard both ways, and a profile without startup
// announcements.
#include "fsm/announcer.hpp"

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include "tests/fsm/flyweight_law.hpp"
#include "tests/fsm/step.hpp"
#include "tests/fsm/survey.hpp"

namespace stormproof::fsm {

namespace announcer_test {

using namespace announcer;
using M = Announcer;
using Input = Flyweight<M>::Input;

const std::vector<Input>& inputs() {
  static const std::vector<Input> all = [] {
    std::vector<Input> list;
    for (const std::int64_t number : {0, 1, 2, 3}) {
      for (const std::int64_t startup : {0, 1, 2, 5})
        list.push_back({7, number, startup, 100, 3'000});
    }
    return list;
  }();
  return all;
}

Input numbered(std::int64_t number, std::int64_t startup) {
  return {.now = 50, .number = number, .startup = startup, .startup_period = 100, .period = 3'000};
}

TEST(Announcer, SendsStartupAnnouncementsAtTheShortPeriod) {
  expect_step<M, Starting, AnnouncementDue, Starting>(numbered(0, 5),
                                                      {.announce = true, .next_at = 150});
  expect_step<M, Starting, AnnouncementDue, Starting>(numbered(4, 5),
                                                      {.announce = true, .next_at = 150});
}

TEST(Announcer, TheLastStartupAnnouncementIsFollowedByTheLongPeriod) {
  expect_step<M, Starting, AnnouncementDue, Periodic>(numbered(5, 5),
                                                      {.announce = true, .next_at = 3'050});
}

TEST(Announcer, WithoutStartupAnnouncementsTheFirstOneIsPeriodic) {
  expect_step<M, Starting, AnnouncementDue, Periodic>(numbered(0, 0),
                                                      {.announce = true, .next_at = 3'050});
}

TEST(Announcer, GoesOnForEver) {
  for (const Input& input : inputs()) {
    expect_step<M, Periodic, AnnouncementDue, Periodic>(
        input, {.announce = true, .next_at = input.now + input.period});
  }
}

TEST(Announcer, FiveStartupAnnouncementsGiveSixInTheFirstHalfSecond) {
  Flyweight<M> engine;
  StateId state = Flyweight<M>::initial;
  std::vector<std::int64_t> times{0};
  for (std::int64_t k = 0; k < 7; ++k) {
    Flyweight<M>::Output output{};
    state = engine.step<AnnouncementDue>(state, {times.back(), k, 5, 100, 3'000}, output);
    times.push_back(output.next_at);
  }
  EXPECT_EQ(times, (std::vector<std::int64_t>{0, 100, 200, 300, 400, 500, 3'500, 6'500}));
}

RC_GTEST_PROP(Announcer, FlyweightEqualsObjectsOfTheirOwn, ()) { FlyweightLaw<M>::check(inputs()); }

}  // namespace announcer_test

MachineSurvey survey_announcer() { return Surveyor<Announcer>{announcer_test::inputs()}.run(); }

}  // namespace stormproof::fsm
