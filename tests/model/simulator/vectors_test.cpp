// The simulator against the tables of test vectors: completion time, every count, and the control
// traffic that is counted apart, exactly; the open-loop baseline; and the channel against lists of
// packets.
#include <gtest/gtest.h>

#include "model/reference.hpp"
#include "model/simulator.hpp"
#include "tests/model/packet_feed.hpp"
#include "tests/vectors/cyclone_vectors.hpp"
#include "tests/vectors/version_vectors.hpp"
#include "tests/vectors/wifi_vectors.hpp"

namespace stormproof {
namespace vectors_test {

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

class Vectors : public testing::TestWithParam<vectors::Vector> {};

TEST_P(Vectors, AgreeExactly) {
  const model::RunResult result = model::simulate(GetParam().scenario);
  EXPECT_EQ(outcome(result), GetParam().expected);
  EXPECT_EQ(static_cast<std::int64_t>(result.user_control), GetParam().user_control);
  EXPECT_EQ(static_cast<std::int64_t>(result.counts.lookup), GetParam().lookup);
  EXPECT_EQ(result.missing_count, 0U);
  EXPECT_TRUE(result.missing.empty());
}

TEST_P(Vectors, AreTheSameFromRunToRun) {
  const model::RunResult first = model::simulate(GetParam().scenario);
  const model::RunResult second = model::simulate(GetParam().scenario);
  EXPECT_EQ(outcome(first), outcome(second));
  EXPECT_EQ(first.user_control, second.user_control);
  EXPECT_EQ(first.events, second.events);
}

const auto name = [](const auto& tested) { return tested.param.name; };
INSTANTIATE_TEST_SUITE_P(Paper, Vectors, testing::ValuesIn(vectors::paper_vectors()), name);
INSTANTIATE_TEST_SUITE_P(FastDds, Vectors, testing::ValuesIn(vectors::fastdds_vectors()), name);
INSTANTIATE_TEST_SUITE_P(Versions, Vectors, testing::ValuesIn(vectors::version_vectors()), name);
INSTANTIATE_TEST_SUITE_P(Cyclone, Vectors, testing::ValuesIn(vectors::cyclone_vectors()), name);
INSTANTIATE_TEST_SUITE_P(Wifi, Vectors, testing::ValuesIn(vectors::wifi_vectors()), name);

class FastDdsVectors : public testing::TestWithParam<vectors::Vector> {};

TEST_P(FastDdsVectors, DeliverEveryDescriptorOnceForTheFirstTime) {
  const model::RunResult result = model::simulate(GetParam().scenario);
  EXPECT_EQ(result.useful_deliveries, result.counts.initial_data);
}

INSTANTIATE_TEST_SUITE_P(All, FastDdsVectors, testing::ValuesIn(vectors::fastdds_vectors()), name);

class OpenLoopVectors : public testing::TestWithParam<vectors::OpenLoopVector> {};

TEST_P(OpenLoopVectors, AgreeExactly) {
  const auto airtime = model::open_loop_airtime(GetParam().scenario);
  ASSERT_TRUE(airtime);
  EXPECT_EQ(airtime->count(), GetParam().airtime_ns);
}

INSTANTIATE_TEST_SUITE_P(All, OpenLoopVectors, testing::ValuesIn(vectors::open_loop_vectors()),
                         name);

class ChannelVectors : public testing::TestWithParam<vectors::ChannelVector> {};

TEST_P(ChannelVectors, AgreeExactly) {
  const vectors::ChannelVector& vector = GetParam();
  EXPECT_EQ(arrivals(vector.wireless, vector.hosts, vector.packets), vector.arrived_ns);
}

INSTANTIATE_TEST_SUITE_P(All, ChannelVectors, testing::ValuesIn(vectors::channel_vectors()), name);

}  // namespace vectors_test
}  // namespace stormproof
