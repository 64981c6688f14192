// Holds the oracle of `implementation: cyclone` to its test vectors. A simulator that is to judge
// another one has to be right itself.
#include "tests/vectors/cyclone_vectors.hpp"

#include <stdexcept>

#include <gtest/gtest.h>

#include "tests/oracle/cyclone_oracle.hpp"

namespace stormproof::oracle {
namespace cyclone_vectors_test {

class CycloneOracleVector : public testing::TestWithParam<vectors::CycloneVector> {};

TEST_P(CycloneOracleVector, AgreesExactly) {
  const CycloneOutcome o = run_cyclone(GetParam().scenario);
  const vectors::Expected actual{o.t_disc_ns, o.initial_data,   o.repair_data, o.heartbeat,
                                 o.acknack,   o.spdp_multicast, o.spdp_unicast};
  EXPECT_TRUE(o.completed);
  EXPECT_TRUE(o.missing.empty());
  EXPECT_EQ(actual, GetParam().expected);
  EXPECT_EQ(o.user_control, GetParam().user_control);
}

INSTANTIATE_TEST_SUITE_P(Cyclone, CycloneOracleVector,
                         testing::ValuesIn(vectors::cyclone_vectors()),
                         [](const auto& test) { return test.param.name; });

TEST(CycloneOracle, WrongDeploymentsAreInputErrors) {
  const auto refused = [](auto change) {
    model::Scenario scenario;
    scenario.deployment = model::Deployment::homogeneous(2, 1, 2);
    model::Participant& participant = scenario.deployment.participants.front();
    participant.start = participant.endpoints_done = model::Nanoseconds{10};
    change(participant);
    EXPECT_THROW(static_cast<void>(run_cyclone(scenario)), std::invalid_argument);
  };
  refused([](model::Participant& p) { p.host = model::HostId{1}; });
  refused([](model::Participant& p) { p.endpoints_done = model::Nanoseconds{9}; });
  refused([](model::Participant& p) { p.open = model::Nanoseconds{11}; });
  refused([](model::Participant& p) { p.ready = model::Nanoseconds{9}; });
}

}  // namespace cyclone_vectors_test
}  // namespace stormproof::oracle
