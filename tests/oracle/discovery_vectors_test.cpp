// Holds the oracle of `implementation: fastdds` to the test vectors with a Discovery Server and
// with static peers.
#include "tests/vectors/discovery_vectors.hpp"

#include <gtest/gtest.h>

#include "tests/oracle/fastdds_oracle.hpp"

namespace stormproof::oracle {
namespace discovery_vectors_test {

class DiscoveryOracleVector : public testing::TestWithParam<vectors::DiscoveryVector> {};

TEST_P(DiscoveryOracleVector, AgreesExactly) {
  const FastddsOutcome o = run_fastdds(GetParam().scenario);
  const vectors::DiscoveryExpected actual{o.t_disc_ns,     o.initial_data,
                                          o.repair_data,   o.heartbeat,
                                          o.acknack,       o.pdp_data + o.spdp_unicast,
                                          o.pdp_heartbeat, o.pdp_acknack,
                                          o.gap,           o.user_control};
  EXPECT_TRUE(o.completed);
  EXPECT_TRUE(o.missing.empty());
  EXPECT_EQ(o.spdp_multicast, 0);
  EXPECT_EQ(actual, GetParam().expected);
}

INSTANTIATE_TEST_SUITE_P(Discovery, DiscoveryOracleVector,
                         testing::ValuesIn(vectors::discovery_vectors()),
                         [](const auto& test) { return test.param.name; });

}  // namespace discovery_vectors_test
}  // namespace stormproof::oracle
