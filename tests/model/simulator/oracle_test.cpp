// The simulator against the oracles (tests/oracle: another author, another style, no shared code)
// on random scenarios of fixed seeds that use every knob. A seed that fails names its scenario:
// print it with config::effective_yaml. Some belong to the first gate.
#include <gtest/gtest.h>

#include "tests/model/packet_feed.hpp"
#include "tests/oracle/comparison.hpp"
#include "tests/oracle/sharp_scenario.hpp"

namespace stormproof {
namespace oracle_test {

/// One of the kinds of random scenarios, and fifty of its seeds.
struct Part {
  const char* kind;
  model::Scenario (*scenario_of)(std::uint64_t);
  int number;
};

class AgainstOracle : public testing::TestWithParam<Part> {};

TEST_P(AgainstOracle, SameEventsSameOutcome) {
  constexpr int scenarios = 50;
  for (int k = 0; k < scenarios; ++k) {
    const auto seed = static_cast<std::uint64_t>(scenarios * GetParam().number + k);
    const auto found = oracle::difference(GetParam().scenario_of(seed));
    ASSERT_FALSE(found.has_value()) << "seed " << seed << ": " << found.value_or("");
  }
}

std::vector<Part> parts(int first, int end) {
  std::vector<Part> list;
  for (int k = first; k < end; ++k) {
    list.push_back({"Paper", oracle::varied_scenario, k});
    list.push_back({"FastDds", oracle::varied_fastdds_scenario, k});
    list.push_back({"Server", oracle::varied_server_scenario, k});
    list.push_back({"Cyclone", oracle::varied_cyclone_scenario, k});
    list.push_back({"Wifi", oracle::varied_wifi_scenario, k});
    list.push_back({"Fleet", oracle::varied_fleet_scenario, k});
    list.push_back({"Queue", oracle::varied_queue_scenario, k});
  }
  return list;
}

const auto name = [](const auto& test) {
  return test.param.kind + std::to_string(test.param.number);
};
INSTANTIATE_TEST_SUITE_P(FirstScenarios, AgainstOracle, testing::ValuesIn(parts(0, 1)), name);
INSTANTIATE_TEST_SUITE_P(RandomScenarios, AgainstOracle, testing::ValuesIn(parts(1, 20)), name);

void expect_same_arrivals(oracle::PacketList (*list_of)(std::uint64_t)) {
  for (std::uint64_t seed = 0; seed < 2'000; ++seed) {
    const oracle::PacketList list = list_of(seed);
    ASSERT_EQ(arrivals(list.wireless, list.hosts, list.packets),
              oracle::feed_units(list.wireless, list.hosts, list.packets))
        << "seed " << seed;
  }
}

TEST(ChannelAgainstOracle, PacketsArriveAtTheSameTimes) {
  expect_same_arrivals(oracle::random_packet_list);
}

TEST(ChannelAgainstOracle, QueuesDropTheSamePackets) {
  expect_same_arrivals(oracle::random_queue_list);
}

}  // namespace oracle_test
}  // namespace stormproof
