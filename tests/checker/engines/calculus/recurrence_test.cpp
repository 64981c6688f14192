// Counts of occasions against schedules that are written out.
#include "checker/engines/calculus/recurrence.hpp"

#include <algorithm>
#include <vector>

#include <gtest/gtest.h>

#include "props/generators/dice.hpp"

namespace stormproof::calculus {
namespace recurrence_test {

using Times = std::vector<std::int64_t>;

/// Most occasions in a closed window, tried from every occasion on.
std::int64_t counted(const Times& occasions, std::int64_t window) {
  std::int64_t most = 0;
  for (const std::int64_t begin : occasions) {
    most = std::max(most, std::ranges::count_if(occasions, [&](std::int64_t t) {
                      return t >= begin && t <= begin + window;
                    }));
  }
  return most;
}

TEST(Recurrence, OfAnnouncements) {
  props::Dice dice{7};
  for (int k = 0; k < 300; ++k) {
    model::SpdpProfile spdp;
    spdp.period = model::Nanoseconds{dice.between(1, 30)};
    spdp.startup_period = model::Nanoseconds{dice.between(1, 30)};
    spdp.startup_announcements = dice.count(0, 4);
    Times schedule{0};
    for (std::uint32_t n = 0; n < 60; ++n) {
      const bool early = n < spdp.startup_announcements;
      schedule.push_back(schedule.back() + (early ? spdp.startup_period : spdp.period).count());
    }
    const std::int64_t window = dice.between(0, 60);
    const std::int64_t bound = Recurrence::announcements(spdp).most(window, 0);
    const std::int64_t most = counted(schedule, window);
    EXPECT_LE(most, bound);
    if (spdp.period >= spdp.startup_period) {
      EXPECT_EQ(most, bound);
    }
  }
}

TEST(Recurrence, OfAttempts) {
  for (const auto interval :
       {model::InitialAckNackInterval::doubling, model::InitialAckNackInterval::constant}) {
    model::SedpProfile sedp;
    sedp.initial_acknack_delay = model::Nanoseconds{3};
    sedp.initial_acknack_interval = interval;
    const bool doubling = interval == model::InitialAckNackInterval::doubling;
    Times schedule;
    std::int64_t delay = 3;
    for (std::int64_t at = 3; at < 3'000; at += delay) {
      schedule.push_back(at);
      if (doubling) delay *= 2;
    }
    for (std::int64_t window = 0; window < 200; ++window) {
      EXPECT_EQ(Recurrence::attempts(sedp).most(window, 0), counted(schedule, window)) << window;
      const auto before = std::ranges::count_if(schedule, [&](auto t) { return t < window; });
      EXPECT_EQ(Recurrence::unheard(sedp).most(0, window), before) << window;
    }
  }
}

TEST(Recurrence, AnswersComeFromLongerWindows) {
  const Recurrence periodic = Recurrence::every(model::Nanoseconds{10});
  EXPECT_EQ(periodic.most(9, 5), 1);
  EXPECT_EQ(periodic.most(10, 5), 2);
  EXPECT_EQ(periodic.answered().most(5, 5), 2);
  EXPECT_EQ(periodic.answered().answered().most(0, 5), 2);
  EXPECT_EQ(Recurrence{}.answered().most(1'000, 1'000), 1);
}

TEST(Recurrence, NeverOverflows) {
  EXPECT_EQ(times(endless, 2), endless);
  EXPECT_EQ(plus(endless, 1), endless);
  const Recurrence fast = Recurrence::every(model::Nanoseconds{1});
  EXPECT_EQ(fast.answered().most(endless, endless), endless);
}

}  // namespace recurrence_test
}  // namespace stormproof::calculus
