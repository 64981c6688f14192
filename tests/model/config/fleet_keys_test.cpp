// `deployment.hosts`, `access_points`, `wireless.loss` and `hosts`: defaults, both forms of a
// deployment, what each needs, and errors at their places.
#include <gtest/gtest.h>

#include "model/config/knobs/effective.hpp"
#include "model/config/scenario_file.hpp"
#include "tests/model/config/test_files.hpp"

namespace stormproof::model::config {
namespace fleet_keys_test {

/// Line 5 begins with the first of `deployment`.
Result<Scenario> read(const std::string& deployment, const std::string& rest = "",
                      const std::string& dds = "fastdds-2.6.11",
                      std::vector<std::string> overrides = {}) {
  const std::string text =
      "dds: " + dds + "\nwireless: wifi-80211n\ntime_limit: 60s\ndeployment:\n" + deployment + rest;
  TestFiles files;
  return read_scenario(files.write("fleet.yaml", text), overrides, source_specs());
}

const std::string per_host = "  participants_per_host: 2\n  endpoints_per_participant: 2\n";
const std::string two_hosts = "  hosts: [{name: base, link: wired}, {name: robot}]\n" + per_host;

std::string error_of(const Result<Scenario>& result) {
  if (result) return "no error";
  const std::string text = to_string(result.error());
  return text.substr(text.find("fleet.yaml"));
}

TEST(FleetKeys, AListIsAsLongAsTheNumberOfHosts) {
  const auto scenario = read(two_hosts);
  ASSERT_TRUE(scenario) << error_of(scenario);
  const Deployment& deployment = scenario->deployment;
  EXPECT_EQ(deployment.participants, Deployment::homogeneous(2, 2, 2).participants);
  ASSERT_EQ(deployment.hosts.size(), 2U);
  EXPECT_EQ(deployment.hosts[0].link, Link::wired);
  EXPECT_EQ(deployment.hosts[1], (Host{"robot", Link::wireless, {}, {}, {}}));
  EXPECT_EQ(deployment.delay_of_cable(), Nanoseconds{50'000});
  EXPECT_TRUE(read("  hosts: 2\n" + per_host)->deployment.hosts.empty());
}

TEST(FleetKeys, EachCanBeSet) {
  const auto scenario = read(
      "  hosts:\n    - {name: a, rate: 54Mbps, access_point: east}\n"
      "    - {name: b, power_save: {dtim: 3}}\n"
      "  access_points: [{name: west, channel: '36'}, {name: east, channel: '40'}]\n"
      "  wired_delay: 1ms\n" +
      per_host);
  ASSERT_TRUE(scenario) << error_of(scenario);
  const Deployment& deployment = scenario->deployment;
  EXPECT_EQ(deployment.hosts[0].rate, BitsPerSecond{54'000'000});
  EXPECT_EQ(deployment.hosts[0].access_point, "east");
  EXPECT_EQ(deployment.hosts[1].power_save, (PowerSave{Nanoseconds{102'400'000}, 3}));
  EXPECT_EQ(deployment.access_points[1], (AccessPoint{"east", "40"}));
  EXPECT_EQ(deployment.delay_of_cable(), Nanoseconds{1'000'000});
  const auto again = parse_scenario(effective_yaml(*scenario), "again", {}, source_specs());
  ASSERT_TRUE(again) << to_string(again.error());
  EXPECT_EQ(*again, *scenario);
}

TEST(FleetKeys, ParticipantsMayBeListedToo) {
  const std::string participants =
      "  participants: [{host: 0, publications: 1, subscriptions: 1},"
      " {host: 1, publications: 1, subscriptions: 1}]\n";
  EXPECT_TRUE(read("  hosts: [{name: a}, {name: b, link: wired}]\n" + participants));
  EXPECT_EQ(error_of(read("  hosts: [{name: a}]\n" + participants)).substr(0, 35),
            "fleet.yaml:5:10: deployment.hosts: ");
}

TEST(FleetKeys, MistakesAreErrorsAtTheirPlaces) {
  const auto of = [](const std::string& hosts, const std::string& points = "") {
    return error_of(read("  hosts: [" + hosts + "]\n" + points + per_host));
  };
  EXPECT_EQ(of("{name: a}, {name: a}"),
            "fleet.yaml:5:29: deployment.hosts.1.name: 'a'; expected a name that no item before "
            "has");
  EXPECT_EQ(of("{name: a, access_point: x}, {name: b}"),
            "fleet.yaml:5:35: deployment.hosts.0.access_point: 'x'; expected no such key, or a "
            "list of access_points");
  EXPECT_EQ(
      of("{name: a, access_point: x}, {name: b}", "  access_points: [{name: y, channel: '1'}]\n"),
      "fleet.yaml:5:35: deployment.hosts.0.access_point: 'x'; expected one of y");
  EXPECT_EQ(of("{name: a, link: wired, rate: 1Mbps}, {name: b}"),
            "fleet.yaml:5:40: deployment.hosts.0.rate: '1Mbps'; expected no such key, or link: "
            "wireless");
  EXPECT_NE(of("{name: a, power_save: {dtim: 1}}, {name: b, power_save: {dtim: 2}}")
                .find("deployment.hosts.1.power_save"),
            std::string::npos);
  EXPECT_NE(error_of(read("  hosts: 2\n  access_points: [{name: y, channel: '1'}]\n" + per_host))
                .find("a list of hosts beside it"),
            std::string::npos);
}

TEST(FleetKeys, HostsNeedReceptionsAndARouteOverAnAccessPoint) {
  EXPECT_NE(error_of(read(two_hosts, "", "paper")).find("implementation: fastdds"),
            std::string::npos);
  const auto wired = read(two_hosts, "", "fastdds-2.6.11", {"wireless=wired"});
  EXPECT_NE(error_of(wired).find("two stages"), std::string::npos);
}

TEST(FleetKeys, LossHasItsDefaultsAndNeedsTheSameRoute) {
  const auto scenario =
      read("  hosts: 2\n" + per_host, "", "fastdds-2.6.11", {"wireless.loss={probability: 0.1}"});
  ASSERT_TRUE(scenario) << to_string(scenario.error());
  EXPECT_EQ(scenario->wireless.loss, (FrameLoss{{1, 10}, 7, 0, {}}));
  EXPECT_TRUE(is_drawn(*scenario));
  EXPECT_FALSE(read("  hosts: 2\n" + per_host, "", "fastdds-2.6.11",
                    {"wireless=mesh-3-hops", "wireless.loss={probability: 0.1}"}));
  EXPECT_FALSE(read("  hosts: 2\n" + per_host, "", "paper", {"wireless.loss={probability: 0.1}"}));
  EXPECT_FALSE(
      read("  hosts: 2\n" + per_host, "", "fastdds-2.6.11", {"wireless.loss={probability: 2}"}));
}

TEST(FleetKeys, ProcessorsAreAProfileByName) {
  const std::vector<std::string> set{"hosts=raspberry-pi-4"};
  const auto scenario = read("  hosts: 2\n" + per_host, "", "fastdds-2.6.11", set);
  ASSERT_TRUE(scenario) << to_string(scenario.error());
  ASSERT_TRUE(scenario->hosts);
  EXPECT_EQ(scenario->hosts->cores, 4U);
  const std::vector<std::string> changed{"hosts=raspberry-pi-4", "hosts.cores=1"};
  EXPECT_EQ(read("  hosts: 2\n" + per_host, "", "fastdds-2.6.11", changed)->hosts->cores, 1U);
  EXPECT_TRUE(read("  hosts: 2\n" + per_host, "", "cyclonedds-0.10", set));
  EXPECT_TRUE(read("  hosts: 2\n" + per_host, "", "fastdds-server-2.6.11", set));
  EXPECT_FALSE(read("  hosts: 2\n" + per_host, "", "paper", set));
  EXPECT_FALSE(read("  hosts: 2\n" + per_host)->hosts);
}

}  // namespace fleet_keys_test
}  // namespace stormproof::model::config
