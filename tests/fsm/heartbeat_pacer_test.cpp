// The interval between the HEARTBEATs of a Cyclone DDS writer at its edges: where it begins to
// double, and its maximum.
#include "fsm/heartbeat_pacer.hpp"

#include <gtest/gtest.h>

namespace stormproof::fsm {
namespace heartbeat_pacer_test {

std::int64_t interval(std::int64_t number, std::int64_t first = 100, std::int64_t most = 8'000) {
  HeartbeatPacerIo::Input<Plain> input{};
  input.interval = first;
  input.interval_max = most;
  return heartbeat_pacer::interval_after<Plain>(input, number);
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

}  // namespace heartbeat_pacer_test
}  // namespace stormproof::fsm
