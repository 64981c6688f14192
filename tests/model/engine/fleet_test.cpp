// Packets between stations, wired hosts and access points, one by one: times that a reader of
// specs/guide/fleet.md can add up by hand.
#include "model/engine/fleet.hpp"

#include <gtest/gtest.h>

#include "tests/model/packet_feed.hpp"

namespace stormproof::model {
namespace fleet_test {

constexpr std::int64_t unicast = 201'924;    // 134 bytes at 144.4 Mbit/s, with overhead
constexpr std::int64_t multicast = 309'167;  // at 6 Mbit/s
constexpr std::int64_t cable = 50'000;

enum class By : std::uint8_t { frame, unit };

class FleetTest : public testing::TestWithParam<By> {
 protected:
  static Scenario scenario(const std::vector<Host>& hosts,
                           const std::vector<AccessPoint>& access_points = {}) {
    Scenario scenario;
    scenario.deployment = Deployment::homogeneous(static_cast<std::uint32_t>(hosts.size()), 1, 0);
    scenario.deployment.hosts = hosts;
    scenario.deployment.access_points = access_points;
    if (GetParam() == By::unit) scenario.wireless = vectors::units_of_80211n();
    return scenario;
  }
  static Host station(const std::string& name) { return {name, Link::wireless, {}, {}, {}}; }
  static Host wired(const std::string& name) { return {name, Link::wired, {}, {}, {}}; }
  static Host at(const std::string& point, const std::string& name) {
    return {name, Link::wireless, {}, point, {}};
  }
};

using Arrivals = std::vector<std::int64_t>;

TEST_P(FleetTest, AWiredHostUsesOnlyTheWayOfTheStation) {
  const Scenario s = scenario({wired("a"), station("b"), wired("c")});
  EXPECT_EQ(arrivals(s, {{0, 0, 1, 68}}), Arrivals{cable + unicast});
  EXPECT_EQ(arrivals(s, {{0, 1, 0, 68}}), Arrivals{unicast + cable});
  EXPECT_EQ(arrivals(s, {{0, 0, 2, 68}}), Arrivals{2 * cable});
  EXPECT_EQ(arrivals(s, {{0, 0, 2, 30'000}}), Arrivals{2 * cable});
}

TEST_P(FleetTest, AccessPointsOfOneChannelShareItOthersDoNot) {
  const std::vector<Host> hosts{wired("a"), at("x", "b"), at("y", "c")};
  const std::vector<vectors::ChannelPacket> both{{0, 0, 1, 68}, {0, 0, 2, 68}};
  EXPECT_EQ(arrivals(scenario(hosts, {{"x", "1"}, {"y", "1"}}), both),
            (Arrivals{cable + unicast, cable + 2 * unicast}));
  EXPECT_EQ(arrivals(scenario(hosts, {{"x", "1"}, {"y", "2"}}), both),
            (Arrivals{cable + unicast, cable + unicast}));
}

TEST_P(FleetTest, MulticastLeavesAtEveryAccessPoint) {
  const std::vector<Host> hosts{wired("a"), at("x", "b"), at("y", "c")};
  const std::vector<vectors::ChannelPacket> one{{0, 0, std::nullopt, 68}};
  EXPECT_EQ(arrivals(scenario(hosts, {{"x", "1"}, {"y", "1"}}), one),
            Arrivals{cable + 2 * multicast});
  EXPECT_EQ(arrivals(scenario(hosts, {{"x", "1"}, {"y", "2"}}), one), Arrivals{cable + multicast});
}

TEST_P(FleetTest, AStationHasItsRateInBothDirections) {
  std::vector<Host> hosts{wired("a"), station("b")};
  hosts[1].rate = BitsPerSecond{8'000'000};  // a byte takes a microsecond
  EXPECT_EQ(arrivals(scenario(hosts), {{0, 0, 1, 68}}), Arrivals{cable + 194'500 + 134'000});
  EXPECT_EQ(arrivals(scenario(hosts), {{0, 1, 0, 68}}), Arrivals{194'500 + 134'000 + cable});
}

TEST_P(FleetTest, WhatIsForASleepingStationWaitsForItsBeacon) {
  std::vector<Host> hosts{wired("a"), station("b"), station("c")};
  hosts[1].power_save = PowerSave{Nanoseconds{1'000'000}, 3};
  const Scenario s = scenario(hosts);
  EXPECT_EQ(arrivals(s, {{0, 0, 1, 68}}), Arrivals{1'000'000 + unicast});
  EXPECT_EQ(arrivals(s, {{950'000, 0, 1, 68}}), Arrivals{1'000'000 + unicast});  // with it
  EXPECT_EQ(arrivals(s, {{950'001, 0, 1, 68}}), Arrivals{2'000'000 + unicast});
  EXPECT_EQ(arrivals(s, {{0, 0, 2, 68}}), Arrivals{cable + unicast});
  EXPECT_EQ(arrivals(s, {{0, 0, std::nullopt, 68}}), Arrivals{3'000'000 + multicast});
  EXPECT_EQ(arrivals(s, {{0, 1, 0, 68}}), Arrivals{unicast + cable});
}

TEST_P(FleetTest, RetriesTakeAirtimeAndAreLimited) {
  Scenario s = scenario({wired("a"), station("b"), wired("c")});
  s.wireless.loss = FrameLoss{{1, 1}, 3, 0, {}};
  const std::vector<vectors::ChannelPacket> packets{{0, 0, 1, 68}, {0, 0, 2, 68}};
  EXPECT_EQ(arrivals(s, packets), (Arrivals{-1, 2 * cable}));
  s.wireless.loss->probability = {1, 1'000'000};
  EXPECT_EQ(arrivals(s, packets), (Arrivals{cable + unicast, 2 * cable}));
  s.wireless.loss = FrameLoss{{1, 2}, 255, 0, {}};
  const std::int64_t arrived = arrivals(s, packets).front() - cable;
  EXPECT_EQ(arrived % unicast, 0);
  EXPECT_GT(arrived, 0);
}

TEST_P(FleetTest, MulticastHasNoRetries) {
  Scenario s = scenario({wired("a"), station("b"), station("c")});
  s.wireless.loss = FrameLoss{{1, 1}, 255, 0, {}};
  EXPECT_EQ(arrivals(s, {{0, 0, std::nullopt, 68}}), Arrivals{-1});
}

INSTANTIATE_TEST_SUITE_P(Services, FleetTest, testing::Values(By::frame, By::unit),
                         [](const auto& one) { return one.param == By::frame ? "frame" : "unit"; });

TEST(Fleet, ADiscoveryServerIsOnHost0) {
  Scenario scenario;
  scenario.deployment = Deployment::homogeneous(2, 2, 0);
  const Fleet fleet{scenario};
  EXPECT_EQ(fleet.host_of(3), 1U);
  EXPECT_EQ(fleet.host_of(4), 0U);
  EXPECT_FALSE(fleet.is_listed());
  EXPECT_EQ(fleet.access_point_count(), 1U);
}

}  // namespace fleet_test
}  // namespace stormproof::model
