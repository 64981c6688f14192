// The files below specs: all of them are valid, and they hold the values that they claim.
#include <fstream>

#include <gtest/gtest.h>

#include "model/config/scenario_file.hpp"
#include "tests/model/config/test_files.hpp"

namespace stormproof::model::config {
namespace specs_test {

DdsProfile dds(const std::string& name) {
  const auto profile = read_dds_profile(name, {}, source_specs());
  EXPECT_TRUE(profile) << to_string(profile.error());
  return profile ? *profile : DdsProfile{};
}

WirelessProfile wireless(const std::string& name) {
  const auto profile = read_wireless_profile(name, {}, source_specs());
  EXPECT_TRUE(profile) << to_string(profile.error());
  return profile ? *profile : WirelessProfile{};
}

TEST(Specs, every_file_is_valid) {
  const SpecPath specs = source_specs();
  for (const std::string& name : specs.names(SpecKind::dds)) dds(name);
  for (const std::string& name : specs.names(SpecKind::wireless)) wireless(name);
  for (const std::string& name : specs.names(SpecKind::scenarios)) {
    const auto scenario = read_scenario(name, {}, specs);
    EXPECT_TRUE(scenario) << to_string(scenario.error());
  }
  EXPECT_GE(specs.names(SpecKind::scenarios).size(), 8U);
}

TEST(Specs, every_file_names_its_schema_and_every_value_of_a_profile_its_source) {
  const SpecPath specs = source_specs();
  for (const SpecKind kind : {SpecKind::scenarios, SpecKind::dds, SpecKind::wireless}) {
    for (const std::string& name : specs.names(kind)) {
      std::ifstream file{*specs.find(kind, name, "", "")};
      std::string line;
      std::getline(file, line);
      EXPECT_TRUE(line.starts_with("# yaml-language-server: $schema=../schema/")) << name;
      if (kind == SpecKind::scenarios) continue;
      for (std::string before = line; std::getline(file, line); before = line) {
        const bool has_value = line.find(": ") != std::string::npos && !line.ends_with(":");
        const bool is_name = line.starts_with("description:") ||
                             line.find("- name:") != std::string::npos ||
                             line.find("channel: air") != std::string::npos;
        if (line.starts_with("#") || !has_value || is_name) continue;
        EXPECT_TRUE(line.find(" # ") != std::string::npos || before.starts_with("# "))
            << name << ": " << line;
      }
    }
  }
}

TEST(Specs, the_paper_profiles_are_the_defaults_of_the_structs) {
  EXPECT_EQ(dds("paper"), DdsProfile{});
  EXPECT_EQ(wireless("wifi-80211n-paper"), WirelessProfile{});
  EXPECT_EQ(wireless("wifi-80211n-2.4ghz"), WirelessProfile{});
}

TEST(Specs, hosts_on_80211n_stall_but_not_those_of_the_paper) {
  WirelessProfile expected;
  expected.order = ServiceOrder::fifo;
  expected.fragment_request = FragmentRequest::at_admission;
  expected.sender = Sender::stalls;
  EXPECT_EQ(wireless("wifi-80211n"), expected);
  for (const char* dds : {"fastdds-2.6.11", "cyclonedds-0.10", "paper"}) {
    const std::vector<std::string> overrides{std::string{"dds="} + dds, "wireless=wifi-80211n"};
    const auto scenario = read_scenario("smallest", overrides, source_specs());
    ASSERT_TRUE(scenario) << to_string(scenario.error());
    EXPECT_EQ(scenario->wireless, dds == std::string{"paper"} ? WirelessProfile{} : expected);
  }
  // Keys on top of it are there with any.
  const std::vector<std::string> overrides{"wireless={base: wifi-80211n, rate_unicast: 1Gbps}"};
  const auto paper = read_scenario("smallest", overrides, source_specs());
  ASSERT_TRUE(paper);
  EXPECT_EQ(paper->wireless.rate_unicast, BitsPerSecond{1'000'000'000});
  EXPECT_EQ(paper->wireless.sender, Sender::backlog);
}

TEST(Specs, units_are_those_of_their_standard) {
  WirelessProfile n;
  n.service = ServedBy::unit;
  n.fragment_request = FragmentRequest::at_admission;
  n.sender = Sender::stalls;
  EXPECT_EQ(wireless("wifi-80211n-ampdu"), n);
  EXPECT_EQ(wireless("wifi-80211n-ampdu-2.4ghz"), n);

  WirelessProfile ac = n;
  ac.overhead_unicast = Nanoseconds{198'500};
  ac.rate_unicast = BitsPerSecond{866'700'000};
  ac.aggregation.max_bytes = Bytes{1'048'575};
  ac.aggregation.overhead = Nanoseconds{202'500};
  EXPECT_EQ(wireless("wifi-80211ac-80"), ac);

  WirelessProfile ax = n;
  ax.overhead_unicast = Nanoseconds{206'500};
  ax.rate_unicast = BitsPerSecond{286'800'000};
  ax.aggregation = {256, Bytes{4'194'303}, Nanoseconds{5'484'000}, Nanoseconds{218'500}};
  EXPECT_EQ(wireless("wifi-80211ax"), ax);
  EXPECT_EQ(wireless("wifi-80211ax-2.4ghz"), ax);
}

TEST(Specs, the_relation_rules_of_fast_dds_differ_from_the_paper_in_six) {
  DdsProfile expected;
  expected.sedp.relation_opening = RelationOpening::each_side;
  expected.sedp.initial_data = InitialData::pull;
  expected.sedp.unmatched = Unmatched::drop;
  expected.sedp.initial_acknack = InitialAckNackReply::heartbeat;
  expected.sedp.acknowledge = Acknowledge::prefix;
  expected.sedp.heartbeat_recipients = HeartbeatRecipients::matched;
  EXPECT_EQ(dds("fastdds-2.6.11-relations"), expected);
}

TEST(Specs, fast_dds_has_the_timers_of_the_paper_until_they_are_corrected) {
  DdsProfile expected;
  expected.implementation = ImplementationKind::fastdds;
  EXPECT_EQ(dds("fastdds-2.6.11"), expected);

  DdsProfile large_buffer = expected;
  large_buffer.sedp.piggyback_threshold_bytes = Bytes{4'000'000};
  EXPECT_EQ(dds("fastdds-2.6.11-sndbuf4M"), large_buffer);

  DdsProfile constant = expected;
  constant.sedp.initial_acknack_interval = InitialAckNackInterval::constant;
  DdsProfile debian = dds("fastdds-2.9.1");
  EXPECT_TRUE(debian.unmodelled.contains("FASTDDS_STATISTICS"));
  debian.unmodelled.clear();
  EXPECT_EQ(debian, constant);

  expected.spdp.resend = SpdpResend::new_only;
  expected.sedp.heartbeat_response_delay = Nanoseconds{10'000'000};
  expected.sedp.nack_response_delay = Nanoseconds{100'000'000};
  expected.sedp.nack_suppression_duration = Nanoseconds{10'000'000};
  EXPECT_EQ(dds("fastdds-2.14.5"), expected);

  expected.version = {.match_order = MatchOrder::builtin_first,
                      .builtin_response_delay = Nanoseconds{11'000'000},
                      .sizes = SizesSince::v3_2,
                      .type_lookup = Whether::yes,
                      .statistics_bytes = Bytes{60},
                      .max_data_per_message = 31};
  EXPECT_EQ(dds("fastdds-3.2"), expected);

  expected.version.sizes = SizesSince::v3_6;
  expected.sedp.piggyback = Piggyback::group;
  EXPECT_EQ(dds("fastdds-3.6"), expected);
}

/// What the version has anyway, and clients that know the server's address alone.
TEST(Specs, since_3_0_clients_know_a_server_by_its_locator) {
  const auto with_server = [](const std::string& version, Discovery discovery) {
    DdsProfile expected = dds("fastdds-" + version);
    expected.discovery = discovery;
    expected.server.relay = Relay::once;
    expected.server.known = ServerKnown::locator;
    expected.server.rejoin = Rejoin::known;
    return expected;
  };
  EXPECT_EQ(dds("fastdds-server-3.2"), with_server("3.2", Discovery::server));
  EXPECT_EQ(dds("fastdds-server-3.6"), with_server("3.6", Discovery::super_client));
  EXPECT_EQ(dds("fastdds-server-2.14.5").server.known, ServerKnown::guid);
  EXPECT_EQ(dds("fastdds-server-2.14.5").server.rejoin, Rejoin::known);
  EXPECT_EQ(dds("fastdds-server-2.6.11").server.rejoin, Rejoin::dropped);
}

TEST(Specs, cyclone_dds_has_the_values_of_its_source) {
  DdsProfile expected;
  expected.implementation = ImplementationKind::cyclone;
  expected.allow_multicast = AllowMulticast::by_network;
  expected.sedp.notification = Notification::fresh_at_once;
  expected.spdp.period = Nanoseconds{8'000'000'000};
  DdsProfile wifi = dds("cyclonedds-0.10");
  EXPECT_FALSE(wifi.unmodelled.empty());
  wifi.unmodelled.clear();
  EXPECT_EQ(wifi, expected);

  DdsProfile newer = dds("cyclonedds-11");
  EXPECT_TRUE(newer.unmodelled.contains("measurements"));
  newer.unmodelled.clear();
  DdsProfile pruning = expected;
  pruning.spdp.initial_prune_delay = Nanoseconds{30'000'000'000};
  pruning.spdp.discovered_prune_delay = Nanoseconds{60'000'000'000};
  EXPECT_EQ(newer, pruning);

  expected.allow_multicast = AllowMulticast::always;
  DdsProfile wired = dds("cyclonedds-0.10-multicast");
  wired.unmodelled.clear();
  EXPECT_EQ(wired, expected);
}

/// What AllowMulticast is by default depends on the network, not on the profile.
TEST(Specs, cyclone_dds_sends_everything_by_multicast_on_a_cable) {
  const auto multicast = [](const std::string& dds, const std::string& wireless) {
    const auto scenario = read_scenario(
        "smallest", std::vector<std::string>{"dds=" + dds, "wireless=" + wireless}, source_specs());
    EXPECT_TRUE(scenario) << (scenario ? "" : to_string(scenario.error()));
    return scenario ? scenario->dds.allow_multicast : AllowMulticast::by_network;
  };
  for (const char* dds : {"cyclonedds-0.10", "cyclonedds-11"}) {
    EXPECT_EQ(multicast(dds, "wired"), AllowMulticast::always) << dds;
    EXPECT_EQ(multicast(dds, "wifi-80211n"), AllowMulticast::spdp) << dds;
  }
  EXPECT_EQ(multicast("{base: cyclonedds-0.10, allow_multicast: spdp}", "wired"),
            AllowMulticast::spdp);
  EXPECT_EQ(multicast("cyclonedds-0.10-multicast", "wifi-80211n"), AllowMulticast::always);
}

/// Whoever has a server has that of the version, whatever it is called.
TEST(Specs, a_server_over_a_preset_without_one_is_that_of_its_version) {
  for (const auto& [simple, server] : {std::pair{"fastdds-2.14.5", "fastdds-server-2.14.5"},
                                       {"lyrical", "fastdds-server-3.6"},
                                       {"kilted", "fastdds-server-3.2"},
                                       {"humble", "fastdds-server-2.6.11"}}) {
    const DdsProfile expected = dds(server);
    const auto chosen = read_dds_profile(simple, std::vector<std::string>{"discovery=super_client"},
                                         source_specs());
    ASSERT_TRUE(chosen) << to_string(chosen.error());
    EXPECT_EQ(chosen->server, expected.server) << simple;
    const auto scenario = read_scenario(
        "smallest", std::vector<std::string>{std::string{"dds="} + simple, "dds.discovery=server"},
        source_specs());
    ASSERT_TRUE(scenario) << to_string(scenario.error());
    EXPECT_EQ(scenario->dds.server, expected.server) << simple;
  }
  const auto own = read_dds_profile(
      "lyrical", std::vector<std::string>{"discovery=server", "server_known=guid"}, source_specs());
  ASSERT_TRUE(own);
  EXPECT_EQ(own->server.known, ServerKnown::guid);
}

TEST(Specs, more_participants_than_find_a_port_are_refused) {
  const auto error = [](std::vector<std::string> changes) {
    const auto scenario = read_scenario("smallest", changes, source_specs());
    return scenario ? std::string{} : to_string(scenario.error());
  };
  const auto on_a_host = [](int participants) {
    return "deployment.participants_per_host=" + std::to_string(participants);
  };
  EXPECT_EQ(error({"dds=fastdds-2.6.11", on_a_host(101)}), "");
  EXPECT_NE(
      error({"dds=fastdds-2.6.11", on_a_host(102)}).find("at most 101 participants on a host"),
      std::string::npos);
  EXPECT_EQ(error({"dds=paper", on_a_host(102)}), "");
  const std::string few = "dds={base: cyclonedds-0.10, max_participants_per_host: 9}";
  EXPECT_EQ(error({few, on_a_host(9)}), "");
  EXPECT_NE(error({few, on_a_host(10)}).find("at most 9 participants on a host, where 10 are"),
            std::string::npos);
}

TEST(Specs, the_live_machine_starts_its_processes_one_after_the_other) {
  const auto live = read_scenario("live-5x20", {}, source_specs());
  const auto wifi = read_scenario("wifi-5x20-fastdds", {}, source_specs());
  ASSERT_TRUE(live && wifi);
  EXPECT_EQ(live->dds, dds("fastdds-2.6.11"));
  EXPECT_EQ(live->wireless, wireless("emulated-ap"));
  EXPECT_EQ(live->deployment.loopback_delay, Nanoseconds{2'000'000});
  ASSERT_TRUE(live->deployment.schedule);
  const Schedule& schedule = *live->deployment.schedule;
  const std::int64_t processes = 5;
  EXPECT_EQ(schedule.start_min, Nanoseconds{3'000'000});
  EXPECT_EQ(schedule.start_max, Nanoseconds{12'000'000 * processes});
  const std::int64_t endpoints = processes * (17 + 20);
  EXPECT_EQ(schedule.endpoints_done_min,
            Nanoseconds{1'000 * (-700 + 2'900 * processes + 200 * endpoints)});
  EXPECT_EQ(schedule.endpoints_done_max,
            Nanoseconds{1'000 * (-27'000 + 15'400 * processes + 455 * endpoints)});

  Deployment quiet = live->deployment;
  quiet.loopback_delay = Nanoseconds{60'000};
  EXPECT_EQ(wifi->deployment, quiet);
  EXPECT_EQ(wifi->wireless, wireless("wifi-80211n-paper"));
}

TEST(Specs, other_wireless_profiles) {
  EXPECT_EQ(wireless("wired").kind, ServiceKind::constant_delay);
  EXPECT_EQ(wireless("wired").one_way, Nanoseconds{100'000});
  EXPECT_EQ(wireless("mesh-3-hops").stages.size(), 3U);
  EXPECT_EQ(wireless("mesh-3-hops").stages[2].channel, wireless("mesh-3-hops").stages[0].channel);
  EXPECT_EQ(wireless("ad-hoc").stages.size(), 1U);
  EXPECT_EQ(wireless("ad-hoc").stages[0].multicast_as, MulticastAs::multicast);

  const WirelessProfile emulated = wireless("emulated-ap");
  EXPECT_EQ(emulated.source_queue_bytes, WirelessProfile::unlimited);
  EXPECT_EQ(emulated.overhead_multicast, Nanoseconds{150'000});
  EXPECT_EQ(emulated.link_overhead_bytes, Bytes{14});
  EXPECT_EQ(emulated.fragment_request, FragmentRequest::at_admission);
  EXPECT_EQ(emulated.order, ServiceOrder::fifo);

  const Stage down = wireless("cellular").stages.at(1);
  EXPECT_NE(down.channel, wireless("cellular").stages[0].channel);
  EXPECT_EQ(down.rate_unicast, BitsPerSecond{150'000'000});
  EXPECT_EQ(down.rate_multicast, BitsPerSecond{20'000'000});
  EXPECT_EQ(down.overhead_unicast, Nanoseconds{200'000});
  EXPECT_EQ(wireless("cellular").stages[0].rate_unicast, BitsPerSecond{50'000'000});
}

}  // namespace specs_test
}  // namespace stormproof::model::config
