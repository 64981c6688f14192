// The channel against lists of packets, and the simulator against whole runs over it, exactly.
#include "tests/vectors/wifi_vectors.hpp"

#include <gtest/gtest.h>

#include "model/simulator.hpp"
#include "tests/model/packet_feed.hpp"

namespace stormproof {
namespace wifi_vectors_test {

class ChannelVectors : public testing::TestWithParam<vectors::ChannelVector> {};

TEST_P(ChannelVectors, AgreeExactly) {
  const vectors::ChannelVector& vector = GetParam();
  EXPECT_EQ(arrivals(vector.wireless, vector.hosts, vector.packets), vector.arrived_ns);
}

INSTANTIATE_TEST_SUITE_P(All, ChannelVectors, testing::ValuesIn(vectors::channel_vectors()),
                         [](const auto& tested) { return tested.param.name; });

vectors::Expected outcome(const model::RunResult& result) {
  const model::Counts& counts = result.counts;
  const auto number = [](std::uint64_t value) { return static_cast<std::int64_t>(value); };
  return {result.discovery_time ? result.discovery_time->count() : -1,
          number(counts.initial_data),
          number(counts.repair_data),
          number(counts.heartbeat),
          number(counts.acknack),
          number(counts.spdp_multicast),
          number(counts.spdp_unicast)};
}

class WifiVectors : public testing::TestWithParam<vectors::FastddsVector> {};

TEST_P(WifiVectors, AgreeExactly) {
  const model::RunResult result = model::simulate(GetParam().scenario);
  EXPECT_EQ(outcome(result), GetParam().expected);
  EXPECT_EQ(static_cast<std::int64_t>(result.user_control), GetParam().user_control);
  EXPECT_EQ(result.missing_count, 0U);
}

INSTANTIATE_TEST_SUITE_P(All, WifiVectors, testing::ValuesIn(vectors::wifi_vectors()),
                         [](const auto& tested) { return tested.param.name; });

}  // namespace wifi_vectors_test
}  // namespace stormproof
