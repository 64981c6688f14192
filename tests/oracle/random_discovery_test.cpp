// Compares product and oracle on random scenarios with a Discovery Server and with static peers:
// those of `implementation: fastdds`, with the other way to discover and with odd knobs of it. Also
// judges these scenarios: a comparison on runs that never finish or never repair would prove
// little.
#include <iostream>

#include <gtest/gtest.h>

#include "props/generators/on_demand.hpp"
#include "tests/oracle/comparison.hpp"
#include "tests/oracle/random_scenario.hpp"
#include "tests/oracle/sharp_scenario.hpp"

namespace stormproof::oracle {
namespace random_discovery_test {

constexpr std::uint64_t seeds = 240;

using model::Discovery;
using model::Scenario;

Scenario random_scenario_of(Discovery discovery, std::uint64_t seed) {
  Scenario scenario = random_fastdds_scenario(seed);
  props::draw_discovery(seed, discovery, scenario);
  return scenario;
}

class RandomDiscovery : public testing::TestWithParam<Discovery> {};

TEST_P(RandomDiscovery, ProductAndOracleAgree) {
  int complete = 0;
  int repaired = 0;
  for (std::uint64_t seed = 0; seed < seeds; ++seed) {
    const Scenario scenario = random_scenario_of(GetParam(), seed);
    const auto found = difference(scenario);
    ASSERT_FALSE(found) << "seed " << seed << ": " << *found;
    const FastddsOutcome outcome =
        run_fastdds(scenario, {}, FastddsMistake::none, most_compared_events);
    complete += outcome.completed ? 1 : 0;
    repaired += outcome.repair_data > 0 ? 1 : 0;
  }
  std::cout << complete << " complete, " << repaired << " with repairs of " << seeds << '\n';
  EXPECT_GT(complete, static_cast<int>(seeds / 4));
  EXPECT_GT(repaired, static_cast<int>(seeds / 10));
}

TEST_P(RandomDiscovery, ProductAndOracleAgreeOnThreadsThatTakeTime) {
  for (std::uint64_t seed = 0; seed < seeds; ++seed) {
    Scenario scenario = random_scenario_of(GetParam(), seed);
    props::Dice dice{seed};
    props::draw_processor(dice, scenario);
    const auto found = difference(scenario);
    ASSERT_FALSE(found) << "seed " << seed << ": " << *found;
  }
}

TEST_P(RandomDiscovery, ProductAndOracleAgreeOnSeveralServers) {
  if (GetParam() == Discovery::static_peers) return;
  for (std::uint64_t seed = 0; seed < seeds; ++seed) {
    Scenario scenario = random_scenario_of(GetParam(), seed);
    draw_unlinked_servers(seed, scenario);
    const auto found = difference(scenario);
    ASSERT_FALSE(found) << "seed " << seed << ": " << *found;
  }
}

INSTANTIATE_TEST_SUITE_P(Ways, RandomDiscovery,
                         testing::Values(Discovery::server, Discovery::super_client,
                                         Discovery::static_peers),
                         [](const auto& test) {
                           switch (test.param) {
                             case Discovery::simple:
                               return "simple";
                             case Discovery::server:
                               return "server";
                             case Discovery::super_client:
                               return "super_client";
                             case Discovery::static_peers:
                               return "static_peers";
                           }
                           return "";
                         });

}  // namespace random_discovery_test
}  // namespace stormproof::oracle
