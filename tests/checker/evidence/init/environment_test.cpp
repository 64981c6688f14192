// What the environment of a robot says is drafted as its distribution and its RMW read it.
#include "checker/evidence/init/environment.hpp"

#include <algorithm>
#include <map>
#include <regex>

#include <gtest/gtest.h>

#include "checker/evidence/init/variables.hpp"
#include "model/config/distributions.hpp"
#include "model/config/scenario_file.hpp"
#include "tests/model/config/test_files.hpp"

namespace stormproof::init {
namespace environment_test {

using Variables = std::map<std::string, std::string>;

model::config::SpecPath specs() { return {{STORMPROOF_SPECS_DIR}}; }

model::config::Result<System> system_of(const Variables& variables) {
  return from_environment(
      {},
      [&](const char* name) -> const char* {
        const auto found = variables.find(name);
        return found == variables.end() ? nullptr : found->second.c_str();
      },
      specs());
}
/// The draft, or why there is none.
std::string drafted(const Variables& variables) {
  const auto system = system_of(variables);
  if (!system) return to_string(system.error());
  const auto text = draft(*system, specs());
  return text ? *text : to_string(text.error());
}
model::Scenario scenario_of(const Variables& variables) {
  const std::string text = drafted(variables);
  const auto read = model::config::parse_scenario(text, "draft", {}, specs());
  EXPECT_TRUE(read) << to_string(read.error()) << "\n" << text;
  return *read;
}
/// In one line, as a comment of several may say it.
bool says(const Variables& variables, const std::string& what) {
  const std::string text = std::regex_replace(drafted(variables), std::regex{"\n#"}, "");
  return text.find(what) != std::string::npos;
}

TEST(Environment, EveryVariableIsReadBySomeDistribution) {
  const auto variables = read_variables(specs().directories);
  ASSERT_TRUE(variables) << to_string(variables.error());
  ASSERT_GT(variables->size(), 10U);
  const auto known = model::config::read_distributions(specs().directories);
  ASSERT_TRUE(known);
  for (const Variable& one : *variables) {
    EXPECT_TRUE(one.rmw == "any" || one.rmw == "fastrtps" || one.rmw == "cyclonedds") << one.name;
    EXPECT_FALSE(one.read_by.empty()) << one.name;
    for (const std::string& distribution : one.read_by) {
      EXPECT_TRUE(
          std::ranges::any_of(*known, [&](const auto& each) { return each.name == distribution; }))
          << one.name << ": " << distribution;
    }
  }
}

TEST(Environment, WhatADistributionDoesNotReadIsSaidAndNotFollowed) {
  const Variables peers{{"ROS_AUTOMATIC_DISCOVERY_RANGE", "LOCALHOST"},
                        {"ROS_STATIC_PEERS", "192.0.2.4"}};
  for (const char* ros : {"humble", "jazzy", "lyrical"}) {
    Variables with = peers;
    with["ROS_DISTRO"] = ros;
    const bool reads = ros != std::string{"humble"};
    const auto expected = reads ? model::Discovery::static_peers : model::Discovery::simple;
    EXPECT_EQ(scenario_of(with).dds.discovery, expected) << drafted(with);
    EXPECT_EQ(says(with, "does not read it; iron, jazzy"), !reads) << drafted(with);
  }
  const Variables cyclone{{"RMW_IMPLEMENTATION", "rmw_cyclonedds_cpp"},
                          {"ROS_DISCOVERY_SERVER", "192.0.2.6:11811"}};
  EXPECT_TRUE(says(cyclone, "rmw_cyclonedds_cpp does not read it"));
}

TEST(Environment, NobodyOnOtherHostsIsNoScenario) {
  const std::string nobody = "nobody on other hosts";
  for (const char* rmw : {"rmw_fastrtps_cpp", "rmw_cyclonedds_cpp"}) {
    Variables local{{"ROS_DISTRO", "jazzy"},
                    {"RMW_IMPLEMENTATION", rmw},
                    {"ROS_LOCALHOST_ONLY", "1"},
                    {"ROS_AUTOMATIC_DISCOVERY_RANGE", "SUBNET"}};
    EXPECT_TRUE(says(local, "ROS_LOCALHOST_ONLY=1: with it " + nobody)) << drafted(local);
    local["ROS_LOCALHOST_ONLY"] = "0";
    EXPECT_FALSE(says(local, nobody)) << drafted(local);
    local["ROS_AUTOMATIC_DISCOVERY_RANGE"] = "subnet";
    EXPECT_TRUE(says(local, "means LOCALHOST")) << drafted(local);
    EXPECT_TRUE(says(local, nobody)) << drafted(local);
    local["ROS_AUTOMATIC_DISCOVERY_RANGE"] = "OFF";
    EXPECT_TRUE(says(local, nobody)) << drafted(local);
  }
  // Kilted has it no more.
  EXPECT_TRUE(says({{"ROS_DISTRO", "kilted"}, {"ROS_LOCALHOST_ONLY", "1"}}, "does not read it"));
}

TEST(Environment, PeersTakeThePlaceOfMulticastOnlyWhereTheRangeSaysSo) {
  Variables peers{{"ROS_DISTRO", "jazzy"}, {"ROS_STATIC_PEERS", "192.0.2.2;192.0.2.3"}};
  EXPECT_EQ(scenario_of(peers).dds.discovery, model::Discovery::simple);
  EXPECT_TRUE(says(peers, "by multicast and to these")) << drafted(peers);
  peers["ROS_AUTOMATIC_DISCOVERY_RANGE"] = "SYSTEM_DEFAULT";
  EXPECT_EQ(scenario_of(peers).dds.discovery, model::Discovery::simple);
  peers["ROS_AUTOMATIC_DISCOVERY_RANGE"] = "LOCALHOST";
  EXPECT_EQ(scenario_of(peers).dds.discovery, model::Discovery::static_peers);
  EXPECT_EQ(scenario_of(peers).dds.peer_ports, 32U);
}

TEST(Environment, AServerMakesClients) {
  Variables client{{"ROS_DISTRO", "humble"}, {"ROS_DISCOVERY_SERVER", "192.0.2.6:11811"}};
  EXPECT_TRUE(says(client, "dds: 'fastdds-server-2.6.11'")) << drafted(client);
  client["ROS_SUPER_CLIENT"] = "TRUE";
  EXPECT_EQ(scenario_of(client).dds.discovery, model::Discovery::super_client);
  client["RMW_IMPLEMENTATION"] = "rmw_connextdds";
  EXPECT_FALSE(system_of(client));
}

TEST(Environment, WhatIsNotInTheModelIsRefused) {
  const auto refuses = [](const std::string& name, const std::string& value) {
    return says({{"ROS_DISTRO", "kilted"}, {name, value}}, name + "=" + value + ": ");
  };
  EXPECT_TRUE(refuses("ROS_DISCOVERY_SERVER", "TCPv4:[192.0.2.5]:42100"));
  EXPECT_TRUE(refuses("ROS_DISCOVERY_SERVER", "192.0.2.5:11811;TCPv4:[192.0.2.6]:42100"));
  for (const char* address : {"[IP_ADDRESS]:11811", "192.168.1.X:11811", "192.0.2.5:port", ";"}) {
    EXPECT_TRUE(refuses("ROS_DISCOVERY_SERVER", address)) << address;
  }
  EXPECT_FALSE(refuses("ROS_DISCOVERY_SERVER", ";192.0.2.5:11811;UDPv4:[192.0.2.6]:11811;robot"));
  EXPECT_TRUE(refuses("ROS_STATIC_PEERS", "192.0.2.4;ROBOT_IP"));
  EXPECT_TRUE(refuses("FASTDDS_BUILTIN_TRANSPORTS", "LARGE_DATA?max_msg_size=1MB"));
  EXPECT_TRUE(refuses("FASTDDS_BUILTIN_TRANSPORTS", "SHM"));
  EXPECT_TRUE(refuses("ROS2_EASY_MODE", "192.0.2.5"));
  EXPECT_TRUE(refuses("ROS_SECURITY_ENABLE", "true"));
  EXPECT_FALSE(refuses("FASTDDS_BUILTIN_TRANSPORTS", "UDPv4"));
  EXPECT_FALSE(refuses("ROS_SECURITY_ENABLE", "false"));
}

TEST(Environment, TheDistributionReadsTheFile) {
  const model::config::TestFiles files;
  const std::string fast = files.write("fast.xml", R"(<?xml version="1.0"?>
<profiles xmlns="http://www.eprosima.com/XMLSchemas/fastRTPS_Profiles">
  <participant profile_name="p" is_default_profile="true"><rtps/></participant>
</profiles>)");
  const Variables jazzy{{"ROS_DISTRO", "jazzy"}, {"FASTRTPS_DEFAULT_PROFILES_FILE", fast}};
  EXPECT_TRUE(says(jazzy, fast + "@fastdds-2.14.5'")) << drafted(jazzy);
  EXPECT_TRUE(says({{"ROS_DISTRO", "jazzy"}, {"FASTDDS_DEFAULT_PROFILES_FILE", fast}},
                   "does not read it; kilted"));
  Variables client = jazzy;
  client["ROS_DISCOVERY_SERVER"] = "192.0.2.6:11811";
  EXPECT_EQ(scenario_of(client).dds.discovery, model::Discovery::server) << drafted(client);
  client["ROS_SUPER_CLIENT"] = "1";
  EXPECT_EQ(scenario_of(client).dds.discovery, model::Discovery::super_client);
  const std::string cyclone =
      files.write("cyclone.xml", "<CycloneDDS><Domain id=\"any\"></Domain></CycloneDDS>");
  const Variables with_cyclone{{"ROS_DISTRO", "jazzy"},
                               {"RMW_IMPLEMENTATION", "rmw_cyclonedds_cpp"},
                               {"CYCLONEDDS_URI", "file://" + cyclone}};
  EXPECT_TRUE(says(with_cyclone, cyclone + "@cyclonedds-0.10'")) << drafted(with_cyclone);
}

TEST(Variables, MistakesHaveTheirPlace) {
  const auto error_of = [](const std::string& text) {
    const model::config::TestFiles files;
    const std::string file = files.write("variables.yaml", text);
    const auto all = read_variables({files.path("none"), files.root()});
    return all ? "" : to_string(all.error()).substr(file.size());
  };
  EXPECT_EQ(error_of("variables: [a]"), ":1:12: variables: a list; expected a map of variables");
  EXPECT_EQ(error_of("variables:\n  A: {rmw: any, read_by: jazzy, source: x}"),
            ":2:26: variables.A.read_by: 'jazzy'; expected a list of distributions");
  EXPECT_EQ(error_of("variables:\n  A: {rmw: any, read_by: [jazzy]}"),
            ":2:6: variables.A.source: missing; expected text");
}

}  // namespace environment_test
}  // namespace stormproof::init
