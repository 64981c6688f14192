// Compares product and oracle on random scenarios with a Discovery Server and with static peers:
// those of `implementation: fastdds`, with the other way to discover and with odd knobs of it. Also
// judges these scenarios: a comparison on runs that never finish or never repair would prove
// little.
#include <algorithm>
#include <iostream>

#include <gtest/gtest.h>

#include "tests/oracle/comparison.hpp"
#include "tests/oracle/random_scenario.hpp"

namespace stormproof::oracle {
namespace random_discovery_test {

constexpr std::uint64_t seeds = 240;

using model::Discovery;
using model::Nanoseconds;
using model::Scenario;

Scenario random_scenario_of(Discovery discovery, std::uint64_t seed) {
  Scenario scenario = random_fastdds_scenario(seed);
  scenario.dds.discovery = discovery;
  scenario.dds.sedp.heartbeat_policy = model::HeartbeatPolicy::periodic;
  scenario.time_limit = std::max(scenario.time_limit, Nanoseconds{3'000'000'000});
  constexpr std::int64_t ms = 1'000'000;
  const auto pick = [&](std::uint64_t salt, std::initializer_list<std::int64_t> values) {
    const std::uint64_t k = (seed * 7919 + salt * 104'729) / 3 % values.size();
    return values.begin()[k];
  };
  scenario.dds.peer_ports = static_cast<std::uint32_t>(pick(1, {1, 2, 4, 7}));
  model::ServerProfile& server = scenario.dds.server;
  server.client_sync_period = Nanoseconds{pick(2, {450, 60, 10, 150}) * ms};
  server.server_routine_period = Nanoseconds{pick(3, {450, 50, 7}) * ms};
  server.pdp_heartbeat_period = Nanoseconds{pick(4, {350, 30}) * ms};
  server.pdp_nack_response_delay = Nanoseconds{pick(5, {100, 0, 3}) * ms};
  server.pdp_nack_suppression_duration = Nanoseconds{pick(6, {11, 0}) * ms};
  server.pdp_heartbeat_response_delay = Nanoseconds{pick(7, {11, 1}) * ms};
  server.relay = seed % 3 == 1 ? model::Relay::once : model::Relay::repeat;
  scenario.deployment.send_cost = Nanoseconds{pick(8, {50, 0, 400}) * 1'000};
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
