// Holds the oracle to the test vectors. A simulator that is to judge another one has to be right
// itself.
#include <stdexcept>

#include <gtest/gtest.h>

#include "tests/oracle/oracle.hpp"
#include "tests/vectors/paper_vectors.hpp"

namespace stormproof::oracle {
namespace vectors_test {

class OracleVector : public testing::TestWithParam<vectors::Vector> {};

TEST_P(OracleVector, AgreesExactly) {
  const Outcome o = run(GetParam().scenario);
  const vectors::Expected actual{o.t_disc_ns, o.initial_data,   o.repair_data, o.heartbeat,
                                 o.acknack,   o.spdp_multicast, o.spdp_unicast};
  EXPECT_TRUE(o.completed);
  EXPECT_TRUE(o.missing.empty());
  EXPECT_EQ(actual, GetParam().expected);
}

INSTANTIATE_TEST_SUITE_P(Paper, OracleVector, testing::ValuesIn(vectors::paper_vectors()),
                         [](const auto& test) { return test.param.name; });

class OracleOpenLoop : public testing::TestWithParam<vectors::OpenLoopVector> {};

TEST_P(OracleOpenLoop, AgreesExactly) {
  EXPECT_EQ(open_loop_ns(GetParam().scenario), GetParam().airtime_ns);
}

INSTANTIATE_TEST_SUITE_P(Paper, OracleOpenLoop, testing::ValuesIn(vectors::open_loop_vectors()),
                         [](const auto& test) { return test.param.name; });

TEST(Oracle, EventsAtTheTimeLimitAreProcessed) {
  model::Scenario scenario = vectors::paper_vectors().front().scenario;
  const std::int64_t t_disc = vectors::paper_vectors().front().expected.t_disc_ns;
  scenario.time_limit = model::Nanoseconds{t_disc};
  EXPECT_TRUE(run(scenario).completed);

  scenario.time_limit = model::Nanoseconds{t_disc - 1};
  const Outcome late = run(scenario);
  EXPECT_FALSE(late.completed);
  EXPECT_EQ(late.t_disc_ns, -1);
  EXPECT_FALSE(late.missing.empty());
}

TEST(Oracle, OneHostIsAnInputError) {
  model::Scenario scenario;
  scenario.deployment = model::Deployment::homogeneous(1, 3, 2);
  EXPECT_THROW(static_cast<void>(run(scenario)), std::invalid_argument);
}

TEST(Oracle, LogIsInTheOrderOfEvents) {
  LogEntry previous;
  std::uint64_t entries = 0;
  const Outcome outcome = run(vectors::paper_vectors().front().scenario, [&](const LogEntry& e) {
    EXPECT_GE(e.time_ns, previous.time_ns);
    previous = e;
    ++entries;
  });
  EXPECT_EQ(entries, outcome.events);
}

}  // namespace vectors_test
}  // namespace stormproof::oracle
