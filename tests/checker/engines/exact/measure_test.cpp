// What `measure` says about runs whose delays are known.
#include "checker/engines/bounds/measure.hpp"

#include <gtest/gtest.h>

#include "checker/engines/smt/claims.hpp"
#include "tests/props/monitored_run.hpp"

namespace stormproof::exact {
namespace measure_test {

Measured measured(const std::string& name, const std::vector<std::string>& overrides = {}) {
  smt::Claims claims;
  const model::Scenario scenario = props::shipped(name, overrides);
  return measure(scenario, checker::CheckRequest{scenario, claims, nullptr, 0, 12, {}});
}

TEST(Measure, ConstantDelay) {
  const Measured m =
      measured("smallest", {"wireless={kind: constant_delay, one_way: 3ms, lost_packets: [5]}"});
  EXPECT_EQ(m.largest_delay, model::Nanoseconds{3'000'000});
  EXPECT_EQ(m.largest_received_delay, model::Nanoseconds{3'000'000});
  EXPECT_EQ(m.largest_initial_data_delay, model::Nanoseconds{3'000'000});
  ASSERT_TRUE(m.t_disc);
  EXPECT_EQ(m.end_time, *m.t_disc);
}

TEST(Measure, OnePacketThatTakesLonger) {
  const Measured m = measured(
      "smallest", {"wireless={kind: constant_delay, one_way: 1ms, packet_delays: [{packet: 0, "
                   "one_way: 9ms}]}"});
  EXPECT_EQ(m.largest_received_delay, model::Nanoseconds{1'000'000});
  EXPECT_EQ(m.largest_delay, m.end_time);  // packet 0 is still under way
  EXPECT_EQ(m.largest_initial_data_delay, model::Nanoseconds{1'000'000});
}

TEST(Measure, AStorm) {
  const Measured m = measured("wifi-5x20");
  EXPECT_EQ(*m.t_disc, model::Nanoseconds{6'262'986'593});
  EXPECT_EQ(m.largest_delay, model::Nanoseconds{6'259'993'843});
  EXPECT_EQ(m.initial_data, 1850U);
  EXPECT_EQ(m.repair_data, 3286U);
  EXPECT_EQ(m.lost, 0U);
}

TEST(Measure, CountsLosses) {
  EXPECT_EQ(measured("smallest", {"wireless.lost_packets=[3,9]"}).lost, 2U);
  EXPECT_EQ(measured("wifi-5x20-fastdds", {"deployment.participants_per_host=1",
                                           "wireless={kind: constant_delay, one_way: 1ms, "
                                           "lost_packets: [3, 9]}"})
                .lost,
            2U);
}

TEST(Measure, AnIncompleteRunHasNoDiscoveryTime) {
  const Measured m = measured("smallest", {"time_limit=10ms"});
  EXPECT_FALSE(m.t_disc);
  EXPECT_GT(m.largest_delay, model::Nanoseconds{});
}

}  // namespace measure_test
}  // namespace stormproof::exact
