// Holds the oracles to the test vectors. A simulator that is to judge another one has to be right
// itself.
#include <stdexcept>

#include <gtest/gtest.h>

#include "tests/oracle/cyclone_oracle.hpp"
#include "tests/oracle/fastdds_oracle.hpp"
#include "tests/oracle/oracle.hpp"
#include "tests/vectors/cyclone_vectors.hpp"
#include "tests/vectors/discovery_vectors.hpp"
#include "tests/vectors/version_vectors.hpp"
#include "tests/vectors/wifi_vectors.hpp"

namespace stormproof::oracle {
namespace vectors_test {

void expect(const vectors::Vector& vector, const Outcome& o, std::int64_t user_control) {
  const vectors::Expected actual{o.t_disc_ns, o.initial_data,   o.repair_data, o.heartbeat,
                                 o.acknack,   o.spdp_multicast, o.spdp_unicast};
  EXPECT_TRUE(o.completed);
  EXPECT_TRUE(o.missing.empty());
  EXPECT_EQ(actual, vector.expected);
  EXPECT_EQ(user_control, vector.user_control);
}

class OracleVector : public testing::TestWithParam<vectors::Vector> {};

TEST_P(OracleVector, AgreesExactly) {
  const model::Scenario& scenario = GetParam().scenario;
  switch (scenario.dds.implementation) {
    case model::ImplementationKind::fastdds: {
      const FastddsOutcome outcome = run_fastdds(scenario);
      EXPECT_EQ(outcome.lookup, GetParam().lookup);
      return expect(GetParam(), outcome, outcome.user_control);
    }
    case model::ImplementationKind::cyclone: {
      const CycloneOutcome outcome = run_cyclone(scenario);
      return expect(GetParam(), outcome, outcome.user_control);
    }
    default:
      return expect(GetParam(), run(scenario), 0);
  }
}

const auto name = [](const auto& test) { return test.param.name; };
INSTANTIATE_TEST_SUITE_P(Paper, OracleVector, testing::ValuesIn(vectors::paper_vectors()), name);
INSTANTIATE_TEST_SUITE_P(FastDds, OracleVector, testing::ValuesIn(vectors::fastdds_vectors()),
                         name);
INSTANTIATE_TEST_SUITE_P(Versions, OracleVector, testing::ValuesIn(vectors::version_vectors()),
                         name);
INSTANTIATE_TEST_SUITE_P(Wifi, OracleVector, testing::ValuesIn(vectors::wifi_vectors()), name);
INSTANTIATE_TEST_SUITE_P(Cyclone, OracleVector, testing::ValuesIn(vectors::cyclone_vectors()),
                         name);

class ChannelOracleVector : public testing::TestWithParam<vectors::ChannelVector> {};

TEST_P(ChannelOracleVector, AgreesExactly) {
  const vectors::ChannelVector& vector = GetParam();
  EXPECT_EQ(feed_units(vector.wireless, vector.hosts, vector.packets), vector.arrived_ns);
}

INSTANTIATE_TEST_SUITE_P(Wifi, ChannelOracleVector, testing::ValuesIn(vectors::channel_vectors()),
                         name);

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
                         testing::ValuesIn(vectors::discovery_vectors()), name);

class OracleOpenLoop : public testing::TestWithParam<vectors::OpenLoopVector> {};

TEST_P(OracleOpenLoop, AgreesExactly) {
  EXPECT_EQ(open_loop_ns(GetParam().scenario), GetParam().airtime_ns);
}

INSTANTIATE_TEST_SUITE_P(Paper, OracleOpenLoop, testing::ValuesIn(vectors::open_loop_vectors()),
                         name);

/// An oracle that answers with an outcome, and an example.
template <class Run>
void expect_time_limit_and_log(Run oracle, const vectors::Vector& vector) {
  model::Scenario scenario = vector.scenario;
  scenario.time_limit = model::Nanoseconds{vector.expected.t_disc_ns};
  EXPECT_TRUE(oracle(scenario, EventLog{}).completed);

  scenario.time_limit = model::Nanoseconds{vector.expected.t_disc_ns - 1};
  const Outcome late = oracle(scenario, EventLog{});
  EXPECT_FALSE(late.completed);
  EXPECT_EQ(late.t_disc_ns, -1);
  EXPECT_FALSE(late.missing.empty());

  LogEntry previous;
  std::uint64_t entries = 0;
  const Outcome outcome = oracle(vector.scenario, [&](const LogEntry& e) {
    EXPECT_GE(e.time_ns, previous.time_ns);
    previous = e;
    ++entries;
  });
  EXPECT_EQ(entries, outcome.events);
}

TEST(Oracle, ProcessesEventsInOrderAndThoseAtTheTimeLimitToo) {
  expect_time_limit_and_log([](const auto& s, const EventLog& log) { return run(s, log); },
                            vectors::paper_vectors().front());
  expect_time_limit_and_log([](const auto& s, const EventLog& log) { return run_fastdds(s, log); },
                            vectors::fastdds_vectors().front());
  expect_time_limit_and_log([](const auto& s, const EventLog& log) { return run_cyclone(s, log); },
                            vectors::cyclone_vectors().front());
}

TEST(Oracle, WrongDeploymentsAreInputErrors) {
  model::Scenario scenario;
  scenario.deployment = model::Deployment::homogeneous(1, 3, 2);
  EXPECT_THROW(static_cast<void>(run(scenario)), std::invalid_argument);
  EXPECT_THROW(static_cast<void>(run_fastdds(scenario)), std::invalid_argument);
  EXPECT_THROW(static_cast<void>(run_cyclone(scenario)), std::invalid_argument);

  scenario.deployment = model::Deployment::homogeneous(2, 1, 2);
  model::Participant& participant = scenario.deployment.participants.front();
  participant.start = model::Nanoseconds{1};
  EXPECT_THROW(static_cast<void>(run_fastdds(scenario)), std::invalid_argument);
  EXPECT_THROW(static_cast<void>(run_cyclone(scenario)), std::invalid_argument);

  participant.start = participant.endpoints_done = model::Nanoseconds{10};
  participant.open = model::Nanoseconds{11};
  EXPECT_THROW(static_cast<void>(run_cyclone(scenario)), std::invalid_argument);
  participant.open.reset();
  participant.ready = model::Nanoseconds{9};
  EXPECT_THROW(static_cast<void>(run_cyclone(scenario)), std::invalid_argument);
}

}  // namespace vectors_test
}  // namespace stormproof::oracle
