// Every value of a profile or scenario knows who wrote it: a file with line and column, a preset,
// or an argument. Vendors' XML stands wherever a profile may stand.
#include <gtest/gtest.h>

#include "model/config/scenario_file.hpp"
#include "model/config/tree/yaml_text.hpp"
#include "tests/model/config/test_files.hpp"

namespace stormproof::model::config {
namespace provenance_test {

constexpr const char* robots_xml = R"(<?xml version="1.0"?>
<dds xmlns="http://www.eprosima.com/XMLSchemas/fastRTPS_Profiles">
  <profiles>
    <participant profile_name="arm" is_default_profile="true">
      <rtps><builtin><discovery_config>
        <leaseAnnouncement><sec>7</sec></leaseAnnouncement>
      </discovery_config></builtin></rtps>
    </participant>
    <participant profile_name="lidar">
      <rtps><builtin><discovery_config>
        <leaseAnnouncement><sec>2</sec></leaseAnnouncement>
      </discovery_config></builtin></rtps>
    </participant>
  </profiles>
</dds>
)";

constexpr const char* server_xml = R"(<profiles>
  <participant profile_name="arm" is_default_profile="true">
    <rtps><builtin><discovery_config>
      <discoveryProtocol>SERVER</discoveryProtocol>
    </discovery_config></builtin></rtps>
  </participant>
</profiles>
)";

std::string place(const Places& places, const std::string& key) {
  const auto found = places.find(key);
  return found == places.end() ? "nowhere" : found->second.to_string();
}

class Provenance : public testing::Test {
 protected:
  Result<TracedProfile> trace(const std::string& reference,
                              const std::vector<std::string>& overrides = {}) const {
    return trace_dds_profile(reference, overrides, source_specs());
  }
  TracedProfile traced(const std::string& reference,
                       const std::vector<std::string>& overrides = {}) const {
    auto profile = trace(reference, overrides);
    EXPECT_TRUE(profile) << to_string(profile.error());
    return profile ? *std::move(profile) : TracedProfile{};
  }
  std::string refusal(const std::string& reference) const {
    const auto profile = trace(reference);
    return profile ? "accepted" : to_string(profile.error());
  }

  const TestFiles files{};
};

TEST_F(Provenance, every_node_of_a_tree_has_its_place) {
  const auto tree = parse_yaml("a: 1\nb:\n  c: [x, {d: y}]\n", "f");
  const Places places = places_of(*tree);
  EXPECT_EQ(places.size(), 6U);
  EXPECT_EQ(place(places, "a"), "f:1:4");
  EXPECT_EQ(place(places, "b"), "f:2:1");
  EXPECT_EQ(place(places, "b.c"), "f:3:6");
  EXPECT_EQ(place(places, "b.c.0"), "f:3:7");
  EXPECT_EQ(place(places, "b.c.1.d"), "f:3:14");
}

TEST_F(Provenance, a_preset_is_its_own_origin) {
  const TracedProfile profile = traced("fastdds-2.14.5");
  EXPECT_EQ(profile.preset, "fastdds-2.14.5");
  EXPECT_FALSE(profile.vendor);
  const std::string folder = std::string{STORMPROOF_SPECS_DIR} + "/dds/";
  EXPECT_TRUE(place(profile.places, "spdp.resend").starts_with(folder + "fastdds-2.14.5.yaml:"));
  EXPECT_TRUE(place(profile.places, "spdp.period").starts_with(folder + "fastdds-2.6.11.yaml:"));
  EXPECT_EQ(profile.value, *read_dds_profile("fastdds-2.14.5", {}, source_specs()));
}

TEST_F(Provenance, a_users_file_and_arguments_are_told_from_the_preset) {
  const std::string mine = files.write("mine.yaml", "base: fastdds-3.6\nspdp:\n  period: 9s\n");
  const TracedProfile profile = traced(mine, {"sedp.heartbeat_period=2s"});
  EXPECT_EQ(profile.reference, mine);
  EXPECT_EQ(profile.preset, "fastdds-3.6");
  EXPECT_EQ(place(profile.places, "spdp.period"), mine + ":3:11");
  EXPECT_EQ(place(profile.places, "sedp.heartbeat_period"), "--set sedp.heartbeat_period=2s");
  EXPECT_EQ(profile.value.spdp.period.count(), 9'000'000'000);
  EXPECT_EQ(profile.value.sedp.heartbeat_period.count(), 2'000'000'000);
}

TEST_F(Provenance, a_profile_on_no_preset_has_none) {
  const std::string whole = files.write("whole.yaml", "base: ./copy.yaml\nspdp: {period: 1s}\n");
  std::ifstream paper{std::string{STORMPROOF_SPECS_DIR} + "/dds/paper.yaml"};
  files.write("copy.yaml", {std::istreambuf_iterator<char>{paper}, {}});
  EXPECT_EQ(traced(whole).preset, "");
  EXPECT_EQ(traced(std::string{STORMPROOF_SPECS_DIR} + "/dds/paper.yaml").preset, "paper");
}

TEST_F(Provenance, a_scenario_has_the_places_of_all_its_parts) {
  const auto traced =
      trace_scenario("wifi-5x20", std::vector<std::string>{"time_limit=9s"}, source_specs());
  ASSERT_TRUE(traced) << to_string(traced.error());
  EXPECT_EQ(place(traced->places, "time_limit"), "--set time_limit=9s");
  EXPECT_NE(place(traced->places, "dds.sedp.heartbeat_period").find("/dds/paper.yaml:"),
            std::string::npos);
  EXPECT_NE(place(traced->places, "wireless.order").find("/wireless/"), std::string::npos);
  const std::string file = std::string{STORMPROOF_SPECS_DIR} + "/scenarios/wifi-5x20.yaml";
  EXPECT_TRUE(place(traced->places, "dds").starts_with(file + ":"));
  EXPECT_EQ(traced->value,
            *read_scenario("wifi-5x20", std::vector<std::string>{"time_limit=9s"}, source_specs()));
}

TEST_F(Provenance, vendor_xml_is_a_profile) {
  const std::string robots = files.write("robots.xml", robots_xml);
  const TracedProfile profile = traced(robots);
  EXPECT_EQ(profile.value.spdp.period.count(), 7'000'000'000);
  EXPECT_EQ(profile.preset, "fastdds-2.6.11");
  ASSERT_TRUE(profile.vendor);
  EXPECT_EQ(profile.vendor->name, "arm");
  EXPECT_TRUE(place(profile.places, "spdp.period").starts_with(robots + ":6:"))
      << place(profile.places, "spdp.period");
  EXPECT_EQ(profile.value, *read_dds_profile(robots, {}, source_specs()));
}

TEST_F(Provenance, vendor_xml_takes_profile_preset_and_overrides) {
  const std::string robots = files.write("team#1@home/robots.xml", robots_xml);
  const TracedProfile profile = traced(robots + "#lidar@fastdds-2.14.5", {"sedp.piggyback=off"});
  EXPECT_EQ(profile.value.spdp.period.count(), 2'000'000'000);
  EXPECT_EQ(profile.value.spdp.resend, SpdpResend::new_only);
  EXPECT_EQ(profile.value.sedp.piggyback, Piggyback::off);
  EXPECT_EQ(profile.preset, "fastdds-2.14.5");
}

TEST_F(Provenance, yaml_stands_on_vendor_xml_beside_it) {
  files.write("xml/robots.xml", robots_xml);
  const std::string near =
      files.write("near.yaml", "base: xml/robots.xml#lidar\nsedp: {heartbeat_period: 4s}\n");
  const std::string top = files.write("above/top.yaml", "base: ../near.yaml\n");
  const TracedProfile profile = traced(top);
  EXPECT_EQ(profile.value.spdp.period.count(), 2'000'000'000);
  EXPECT_EQ(profile.value.sedp.heartbeat_period.count(), 4'000'000'000);
  ASSERT_TRUE(profile.vendor);
  EXPECT_EQ(profile.vendor->name, "lidar");
  EXPECT_EQ(place(profile.places, "sedp.heartbeat_period"), near + ":2:26");
}

TEST_F(Provenance, a_scenario_takes_vendor_xml) {
  files.write("robots.xml", robots_xml);
  const std::string scenario =
      files.write("s.yaml",
                  "deployment: {hosts: 2, participants_per_host: 1, endpoints_per_participant: 2}\n"
                  "dds: robots.xml\nwireless: emulated-ap\ntime_limit: 5s\n");
  const auto own = read_scenario(scenario, {}, source_specs());
  ASSERT_TRUE(own) << to_string(own.error());
  EXPECT_EQ(own->dds.spdp.period.count(), 7'000'000'000);
  const std::vector<std::string> overrides{"dds=" + files.path("robots.xml") + "#lidar",
                                           "dds.sedp.heartbeat_period=3s"};
  const auto other = read_scenario("live-5x20", overrides, source_specs());
  ASSERT_TRUE(other) << to_string(other.error());
  EXPECT_EQ(other->dds.spdp.period.count(), 2'000'000'000);
  EXPECT_EQ(other->dds.sedp.heartbeat_period.count(), 3'000'000'000);
}

TEST_F(Provenance, wrong_references_to_vendor_xml_are_refused_where_they_stand) {
  const std::string robots = files.write("robots.xml", robots_xml);
  EXPECT_TRUE(refusal(files.path("lost.xml")).starts_with(files.path("lost.xml") + ": no file "))
      << refusal(files.path("lost.xml"));
  EXPECT_TRUE(
      refusal(robots + "@nosuch").starts_with(robots + "@nosuch: no dds file named 'nosuch'"))
      << refusal(robots + "@nosuch");
  EXPECT_NE(refusal(robots + "#nosuch").find("nosuch"), std::string::npos);
  EXPECT_EQ(refusal(robots + "@cyclonedds-0.10"),
            robots +
                "@cyclonedds-0.10: 'cyclonedds-0.10' is a preset of Cyclone DDS; expected one "
                "of Fast DDS, whose file this is");
  const std::string yaml = files.write("y.yaml", "spdp: {}\nbase: robots.xml@nosuch\n");
  EXPECT_TRUE(refusal(yaml).starts_with(yaml + ":2:7: no dds file named 'nosuch'"))
      << refusal(yaml);
  files.write("folder.xml/x", "");
  EXPECT_NE(refusal(files.path("folder.xml")).find("is a directory"), std::string::npos);
  files.write("binary.xml", std::string{"\x7f"
                                        "ELF\0\1\2",
                                        7});
  EXPECT_TRUE(refusal(files.path("binary.xml")).starts_with(files.path("binary.xml") + ":1:"));
  const auto scenario = read_scenario(robots, {}, source_specs());
  ASSERT_FALSE(scenario);
  EXPECT_NE(scenario.error().message.find("--set dds="), std::string::npos);
}

TEST_F(Provenance, a_chain_with_vendor_xml_in_it_has_an_end) {
  files.write("robots.xml", robots_xml);
  const std::string a = files.write("a.yaml", "base: robots.xml@./a.yaml\n");
  EXPECT_NE(refusal(a).find("is based on itself"), std::string::npos) << refusal(a);
}

TEST_F(Provenance, what_the_model_cannot_describe_is_shown_but_not_run) {
  const std::string server = files.write("server.xml", server_xml);
  const std::string reason = refusal(server);
  EXPECT_TRUE(reason.starts_with(server + ":4:")) << reason;
  EXPECT_TRUE(trace_dds_profile(server, {}, source_specs(), Outside::admitted));
}

TEST_F(Provenance, what_the_model_has_not_got_adds_up) {
  const std::string below =
      files.write("below.yaml", "base: fastdds-2.6.11\nunmodelled: {a: one, b: two}\n");
  const std::string above =
      files.write("above.yaml", "base: ./below.yaml\nunmodelled: {b: three}\n");
  const TracedProfile profile = traced(above);
  EXPECT_EQ(profile.value.unmodelled.at("a"), "one");
  EXPECT_EQ(profile.value.unmodelled.at("b"), "three");
  EXPECT_EQ(place(profile.places, "unmodelled.a"), below + ":2:17");
  EXPECT_EQ(place(profile.places, "unmodelled.b"), above + ":2:17");
}

}  // namespace provenance_test
}  // namespace stormproof::model::config
