// The simulator against the oracles (tests/oracle: another author, another style, no shared code)
// on random scenarios of fixed seeds that use every knob. A seed that fails names its scenario:
// print it with config::effective_yaml.
#include <gtest/gtest.h>

#include "tests/model/packet_feed.hpp"
#include "tests/oracle/comparison.hpp"
#include "tests/oracle/sharp_scenario.hpp"

namespace stormproof {
namespace oracle_test {

class AgainstOracle : public testing::TestWithParam<int> {
 protected:
  static void expect_agreement(model::Scenario (*scenario_of)(std::uint64_t)) {
    constexpr int scenarios = 50;
    for (int k = 0; k < scenarios; ++k) {
      const auto seed = static_cast<std::uint64_t>(scenarios * GetParam() + k);
      const auto found = oracle::difference(scenario_of(seed));
      ASSERT_FALSE(found.has_value()) << "seed " << seed << ": " << found.value_or("");
    }
  }
};

class AgainstPaperOracle : public AgainstOracle {};
TEST_P(AgainstPaperOracle, SameEventsSameOutcome) { expect_agreement(oracle::varied_scenario); }
INSTANTIATE_TEST_SUITE_P(RandomScenarios, AgainstPaperOracle, testing::Range(0, 20));

class AgainstFastddsOracle : public AgainstOracle {};
TEST_P(AgainstFastddsOracle, SameEventsSameOutcome) {
  expect_agreement(oracle::varied_fastdds_scenario);
}
INSTANTIATE_TEST_SUITE_P(RandomScenarios, AgainstFastddsOracle, testing::Range(0, 14));

class AgainstWifiOracle : public AgainstOracle {};
TEST_P(AgainstWifiOracle, SameEventsSameOutcome) { expect_agreement(oracle::varied_wifi_scenario); }
INSTANTIATE_TEST_SUITE_P(RandomScenarios, AgainstWifiOracle, testing::Range(0, 14));

class AgainstFleetOracle : public AgainstOracle {};
TEST_P(AgainstFleetOracle, SameEventsSameOutcome) {
  expect_agreement(oracle::varied_fleet_scenario);
}
INSTANTIATE_TEST_SUITE_P(RandomScenarios, AgainstFleetOracle, testing::Range(0, 14));

TEST(ChannelAgainstOracle, PacketsArriveAtTheSameTimes) {
  for (std::uint64_t seed = 0; seed < 2'000; ++seed) {
    const oracle::PacketList list = oracle::random_packet_list(seed);
    ASSERT_EQ(arrivals(list.wireless, list.hosts, list.packets),
              oracle::feed_units(list.wireless, list.hosts, list.packets))
        << "seed " << seed;
  }
}

}  // namespace oracle_test
}  // namespace stormproof
