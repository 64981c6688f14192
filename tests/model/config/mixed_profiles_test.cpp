// Profiles of participants and hosts: where they may stand, whose they are, and which do not go
// together.
#include <gtest/gtest.h>

#include "model/config/knobs/effective.hpp"
#include "model/config/scenario_file.hpp"
#include "tests/model/config/test_files.hpp"

namespace stormproof::model::config {
namespace mixed_profiles_test {

Result<Scenario> read(const std::string& deployment, const std::string& dds = "fastdds-2.6.11",
                      const std::vector<std::string>& overrides = {}) {
  return parse_scenario(
      "deployment: " + deployment + "\ndds: " + dds + "\nwireless: wired\ntime_limit: 1s\n", "f",
      overrides, source_specs());
}
DdsProfile preset(const std::string& name) { return *read_dds_profile(name, {}, source_specs()); }

const std::string of_hosts =
    "{hosts: [{name: a}, {name: b, dds: fastdds-3.6}], participants_per_host: 2, "
    "endpoints_per_participant: 2}";

TEST(MixedProfiles, OfHostsAreThoseOfTheirParticipants) {
  const auto scenario = read(of_hosts);
  ASSERT_TRUE(scenario) << to_string(scenario.error());
  EXPECT_TRUE(is_mixed(*scenario));
  EXPECT_TRUE(scenario->deployment.hosts.empty());  // they have nothing else to say
  for (const std::uint32_t i : {0U, 1U}) {
    EXPECT_EQ(dds_of(*scenario, i), preset("fastdds-2.6.11")) << i;
    EXPECT_EQ(dds_of(*scenario, i + 2), preset("fastdds-3.6")) << i;
  }
}

TEST(MixedProfiles, OfParticipantsCountBeforeThoseOfHosts) {
  const auto scenario = read(
      "{hosts: [{name: a}, {name: b, dds: fastdds-3.6}], participants: ["
      "{host: 0, publications: 1, subscriptions: 1}, {host: 1, publications: 1, subscriptions: 1},"
      "{host: 1, publications: 1, subscriptions: 1, dds: {base: fastdds-2.14.5, spdp: {period: "
      "7s}}}]}");
  ASSERT_TRUE(scenario) << to_string(scenario.error());
  EXPECT_EQ(dds_of(*scenario, 1), preset("fastdds-3.6"));
  DdsProfile changed = preset("fastdds-2.14.5");
  changed.spdp.period = Nanoseconds{7'000'000'000};
  EXPECT_EQ(dds_of(*scenario, 2), changed);
}

TEST(MixedProfiles, OverridesChooseAndChangeThem) {
  const auto scenario =
      read(of_hosts, "fastdds-2.6.11",
           {"deployment.hosts.1.dds=jazzy", "deployment.hosts.1.dds.sedp.heartbeat_period=2s"});
  ASSERT_TRUE(scenario) << to_string(scenario.error());
  DdsProfile changed = preset("fastdds-2.14.5");
  changed.sedp.heartbeat_period = Nanoseconds{2'000'000'000};
  EXPECT_EQ(dds_of(*scenario, 2), changed);
}

TEST(MixedProfiles, AreWrittenAndReadAgain) {
  const auto scenario = read(of_hosts);
  ASSERT_TRUE(scenario);
  const auto again = parse_scenario(effective_yaml(*scenario), "again", {}, SpecPath{});
  ASSERT_TRUE(again) << to_string(again.error());
  EXPECT_EQ(*again, *scenario);
}

TEST(MixedProfiles, LeasesAreTheirOwn) {
  const auto scenario = read(
      "{hosts: 2, participants_per_host: 1, endpoints_per_participant: 2, life: {outages: [{from: "
      "0, to: 1, start: 1s, end: 2s}]}}",
      "{base: cyclonedds-0.10, spdp: {lease: 5s}}");
  ASSERT_TRUE(scenario) << to_string(scenario.error());
  Scenario mixed = *scenario;
  mixed.deployment.life->lease.reset();
  DdsProfile other = mixed.dds;
  other.spdp.lease = Nanoseconds{20'000'000'000};
  mixed.deployment.participants[1].dds = other;
  choose_lease(mixed);
  EXPECT_EQ(mixed.deployment.life->lease, Nanoseconds{5'000'000'000});
  EXPECT_EQ(mixed.deployment.life->leases, (std::vector{Lease{1, Nanoseconds{20'000'000'000}}}));
}

/// What is said of it, or "accepted".
std::string refusal(const std::string& own, const std::string& whole) {
  const auto scenario = read("{hosts: [{name: a}, {name: b, dds: " + own +
                                 "}], participants_per_host: 1, endpoints_per_participant: 2}",
                             whole);
  return scenario ? "accepted" : to_string(scenario.error());
}

TEST(MixedProfiles, WhatDoesNotGoTogetherIsRefused) {
  EXPECT_EQ(refusal("fastdds-static-2.6.11", "fastdds-static-2.6.11"), "accepted");
  EXPECT_EQ(refusal("cyclonedds-0.10", "cyclonedds-11"), "accepted");
  EXPECT_EQ(refusal("cyclonedds-0.10", "fastdds-2.6.11"),
            "f:1:48: deployment.hosts.1.dds: a profile with implementation: cyclone; expected one "
            "with implementation: fastdds, as the scenario's has it: what the two make of each "
            "other nobody has stated");
  EXPECT_EQ(refusal("{base: paper, spdp: {period: 1s}}", "paper"),
            "f:1:1: deployment.participants.1.dds: expected none: only versions of Fast DDS, or of "
            "Cyclone DDS, run beside each other; the paper has one profile for all");
  EXPECT_NE(refusal("fastdds-static-2.6.11", "fastdds-2.6.11")
                .find("a profile that discovers as the scenario's does"),
            std::string::npos);
  EXPECT_NE(refusal("fastdds-server-2.14.5", "fastdds-server-2.6.11")
                .find("a Discovery Server and its clients have one profile here"),
            std::string::npos);
  EXPECT_NE(refusal("fastdds-9.9", "fastdds-2.6.11").find("fastdds-9.9"), std::string::npos);
}

TEST(MixedProfiles, TheOneThatLetsTheFewestStartCounts) {
  const std::string text =
      "{hosts: [{name: a}, {name: b, dds: {base: fastdds-2.14.5, max_participants_per_host: 1}}], "
      "participants_per_host: 2, endpoints_per_participant: 2}";
  const auto scenario = read(text);
  ASSERT_FALSE(scenario);
  EXPECT_NE(scenario.error().message.find("at most 1 participants on a host"), std::string::npos);
}

}  // namespace mixed_profiles_test
}  // namespace stormproof::model::config
