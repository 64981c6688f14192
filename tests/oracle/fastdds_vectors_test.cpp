// Holds the oracle of `implementation: fastdds` to its test vectors. A simulator that is to judge
// another one has to be right itself.
#include "tests/vectors/fastdds_vectors.hpp"

#include <stdexcept>

#include <gtest/gtest.h>

#include "tests/oracle/fastdds_oracle.hpp"
#include "tests/vectors/wifi_vectors.hpp"

namespace stormproof::oracle {
namespace fastdds_vectors_test {

class FastddsOracleVector : public testing::TestWithParam<vectors::FastddsVector> {};

TEST_P(FastddsOracleVector, AgreesExactly) {
  const FastddsOutcome o = run_fastdds(GetParam().scenario);
  const vectors::Expected actual{o.t_disc_ns, o.initial_data,   o.repair_data, o.heartbeat,
                                 o.acknack,   o.spdp_multicast, o.spdp_unicast};
  EXPECT_TRUE(o.completed);
  EXPECT_TRUE(o.missing.empty());
  EXPECT_EQ(actual, GetParam().expected);
  EXPECT_EQ(o.user_control, GetParam().user_control);
}

INSTANTIATE_TEST_SUITE_P(Fastdds, FastddsOracleVector,
                         testing::ValuesIn(vectors::fastdds_vectors()),
                         [](const auto& test) { return test.param.name; });

INSTANTIATE_TEST_SUITE_P(Wifi, FastddsOracleVector, testing::ValuesIn(vectors::wifi_vectors()),
                         [](const auto& test) { return test.param.name; });

class ChannelOracleVector : public testing::TestWithParam<vectors::ChannelVector> {};

TEST_P(ChannelOracleVector, AgreesExactly) {
  const vectors::ChannelVector& vector = GetParam();
  EXPECT_EQ(feed_units(vector.wireless, vector.hosts, vector.packets), vector.arrived_ns);
}

INSTANTIATE_TEST_SUITE_P(Wifi, ChannelOracleVector, testing::ValuesIn(vectors::channel_vectors()),
                         [](const auto& test) { return test.param.name; });

TEST(FastddsOracle, EventsAtTheTimeLimitAreProcessed) {
  model::Scenario scenario = vectors::fastdds_vectors().front().scenario;
  const std::int64_t t_disc = vectors::fastdds_vectors().front().expected.t_disc_ns;
  scenario.time_limit = model::Nanoseconds{t_disc};
  EXPECT_TRUE(run_fastdds(scenario).completed);

  scenario.time_limit = model::Nanoseconds{t_disc - 1};
  const FastddsOutcome late = run_fastdds(scenario);
  EXPECT_FALSE(late.completed);
  EXPECT_EQ(late.t_disc_ns, -1);
  EXPECT_FALSE(late.missing.empty());
}

TEST(FastddsOracle, WrongDeploymentsAreInputErrors) {
  model::Scenario scenario;
  scenario.deployment = model::Deployment::homogeneous(1, 3, 2);
  EXPECT_THROW(static_cast<void>(run_fastdds(scenario)), std::invalid_argument);

  scenario.deployment = model::Deployment::homogeneous(2, 1, 2);
  scenario.deployment.participants.front().start = model::Nanoseconds{1};
  EXPECT_THROW(static_cast<void>(run_fastdds(scenario)), std::invalid_argument);
}

TEST(FastddsOracle, LogIsInTheOrderOfEvents) {
  LogEntry previous;
  std::uint64_t entries = 0;
  const model::Scenario& scenario = vectors::fastdds_vectors().front().scenario;
  const FastddsOutcome outcome = run_fastdds(scenario, [&](const LogEntry& e) {
    EXPECT_GE(e.time_ns, previous.time_ns);
    previous = e;
    ++entries;
  });
  EXPECT_EQ(entries, outcome.events);
}

}  // namespace fastdds_vectors_test
}  // namespace stormproof::oracle
