// Holds the simulator to the test vectors with a Discovery Server and with static peers.
#include "tests/vectors/discovery_vectors.hpp"

#include <gtest/gtest.h>

#include "model/engine/topology.hpp"
#include "model/simulator.hpp"

namespace stormproof::model {
namespace discovery_vectors_test {

class DiscoveryVector : public testing::TestWithParam<vectors::DiscoveryVector> {};

TEST_P(DiscoveryVector, AgreesExactly) {
  const RunResult r = simulate(GetParam().scenario);
  const auto number = [](std::uint64_t value) { return static_cast<std::int64_t>(value); };
  const Counts& c = r.counts;
  ASSERT_TRUE(r.completed());
  const vectors::DiscoveryExpected actual{
      r.discovery_time->count(), number(c.initial_data), number(c.repair_data),
      number(c.heartbeat),       number(c.acknack),      number(c.pdp_data + c.spdp_unicast),
      number(c.pdp_heartbeat),   number(c.pdp_acknack),  number(c.gap),
      number(r.user_control)};
  EXPECT_TRUE(r.missing.empty());
  EXPECT_EQ(c.spdp_multicast, 0U);
  EXPECT_EQ(actual, GetParam().expected);
}

TEST_P(DiscoveryVector, DeliversEveryNeededDescriptorOnce) {
  const RunResult r = simulate(GetParam().scenario);
  EXPECT_EQ(r.missing_count, 0U);
  EXPECT_EQ(r.useful_deliveries, topology_of(GetParam().scenario).required_deliveries());
}

INSTANTIATE_TEST_SUITE_P(Discovery, DiscoveryVector,
                         testing::ValuesIn(vectors::discovery_vectors()),
                         [](const auto& test) { return test.param.name; });

}  // namespace discovery_vectors_test
}  // namespace stormproof::model
