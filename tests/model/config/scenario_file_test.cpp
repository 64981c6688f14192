// Reading of good scenarios: every form, every default, every kind of override.
#include "model/config/scenario_file.hpp"

#include <gtest/gtest.h>

#include "tests/model/config/test_files.hpp"

namespace stormproof::model::config {
namespace scenario_file_test {

const std::string plain =
    "deployment: {hosts: 2, participants_per_host: 1, endpoints_per_participant: 3}\n"
    "dds: paper\n"
    "wireless: wifi-80211n\n"
    "time_limit: 5s\n";

Result<Scenario> parse(const std::string& text, const std::vector<std::string>& overrides = {}) {
  return parse_scenario(text, "s.yaml", overrides, source_specs());
}

Scenario scenario(const std::string& text, const std::vector<std::string>& overrides = {}) {
  const auto read = parse(text, overrides);
  EXPECT_TRUE(read) << to_string(read.error());
  return read ? *read : Scenario{};
}

std::string refusal(const std::vector<std::string>& overrides) {
  const auto read = parse(plain, overrides);
  return read ? "accepted" : to_string(read.error());
}

TEST(ScenarioFile, the_short_form_gives_the_odd_endpoint_to_the_publications) {
  const Scenario read = scenario(plain);
  EXPECT_EQ(read.deployment, Deployment::homogeneous(2, 1, 3));
  EXPECT_EQ(read.deployment.participants[1].publications, 2U);
  EXPECT_EQ(read.dds, DdsProfile{});
  EXPECT_EQ(read.wireless, WirelessProfile{});
  EXPECT_EQ(read.time_limit, Nanoseconds{5'000'000'000});
}

TEST(ScenarioFile, the_list_form_keeps_order_and_starts) {
  const Scenario read = scenario(
      "description: any text\n"
      "deployment:\n"
      "  participants:\n"
      "    - {host: 7, publications: 3, subscriptions: 2, start: 1.5ms}\n"
      "    - {host: 0, publications: 0, subscriptions: 0}\n"
      "dds: {base: paper, sedp: {heartbeat_timer: additive}}\n"
      "wireless: {base: wifi-80211n, order: datagram_uplink, lost_packets: [40, 3, 40]}\n"
      "time_limit: 200s\n");
  ASSERT_EQ(read.deployment.size(), 2U);
  EXPECT_EQ(read.deployment.participants[0].host.value, 7U);
  EXPECT_EQ(read.deployment.participants[0].start, Nanoseconds{1'500'000});
  EXPECT_EQ(read.deployment.participants[1].start, Nanoseconds{0});
  EXPECT_EQ(read.dds.sedp.heartbeat_timer, HeartbeatTimerKind::additive);
  EXPECT_EQ(read.dds.sedp.heartbeat_period, Nanoseconds{1'000'000'000});
  EXPECT_EQ(read.wireless.order, ServiceOrder::datagram_uplink);
  EXPECT_EQ(read.wireless.lost_packets, (std::vector<std::uint64_t>{3, 40}));
}

TEST(ScenarioFile, a_constant_delay_needs_nothing_of_a_channel) {
  const Scenario read = scenario(plain, {"wireless={kind: constant_delay, one_way: 300us}"});
  EXPECT_EQ(read.wireless.one_way, Nanoseconds{300'000});
  EXPECT_EQ(refusal({"wireless={kind: constant_delay}"}),
            "--set wireless={kind: constant_delay}: missing key 'one_way' in wireless; expected a "
            "duration from 0s to 1000000s");
  EXPECT_NE(refusal({"wireless=wired", "wireless.kind=shared_channel"})
                .find("missing key 'overhead_unicast'"),
            std::string::npos);
}

TEST(ScenarioFile, overrides_reach_every_key) {
  const Scenario read =
      scenario(plain, {"deployment.hosts=3", "dds.sedp.heartbeat_period=500ms",
                       "wireless.stages.0.channel=x", "wireless.stages.1.rate_multicast=1Mbps",
                       "wireless.source_queue_bytes=unlimited", "dds.sedp.adaptive.epsilon=1/10",
                       "time_limit=1s", "description=other"});
  EXPECT_EQ(read.deployment.size(), 3U);
  EXPECT_EQ(read.dds.sedp.heartbeat_period, Nanoseconds{500'000'000});
  EXPECT_EQ(read.dds.sedp.adaptive.epsilon_denominator, 10);
  EXPECT_EQ(read.wireless.stages[0].channel, "x");
  EXPECT_EQ(read.wireless.stages[1].rate_multicast, BitsPerSecond{1'000'000});
  EXPECT_EQ(read.wireless.source_queue_bytes, WirelessProfile::unlimited);
  EXPECT_EQ(read.time_limit, Nanoseconds{1'000'000'000});
}

TEST(ScenarioFile, overrides_replace_profiles_before_they_change_them) {
  const Scenario read =
      scenario(plain, {"dds.sedp.acknowledge=bitmap", "dds=fastdds-2.6.11-relations",
                       "wireless.base=ad-hoc", "wireless.order=fifo"});
  EXPECT_EQ(read.dds.sedp.initial_data, InitialData::pull);
  EXPECT_EQ(read.dds.sedp.acknowledge, Acknowledge::bitmap);
  EXPECT_EQ(read.wireless.stages.size(), 1U);
  EXPECT_EQ(read.wireless.order, ServiceOrder::fifo);
}

TEST(ScenarioFile, the_last_override_of_a_key_counts) {
  EXPECT_EQ(scenario(plain, {"time_limit=1s", "time_limit=2s"}).time_limit,
            Nanoseconds{2'000'000'000});
}

TEST(ScenarioFile, an_override_is_the_place_of_its_mistakes) {
  EXPECT_EQ(refusal({"dds.sedp.heartbeat_period=5"}),
            "--set dds.sedp.heartbeat_period=5: dds.sedp.heartbeat_period: '5' has no unit (ns, "
            "us, ms, s); expected "
            "a duration from 1ns to 1000000s");
  EXPECT_EQ(refusal({"dds.sepd.heartbeat_period=5s"}),
            "--set dds.sepd.heartbeat_period=5s: unknown key 'sepd' in dds; did you mean 'sedp'?");
  EXPECT_EQ(
      refusal({"wireless.stages.2.name=x"}),
      "--set wireless.stages.2.name=x: there is no element 2; the list has 2 (numbered from 0)");
  EXPECT_EQ(refusal({"time_limit.x=1"}),
            "--set time_limit.x=1: 'time_limit' has no keys below it: it is '5s'");
  EXPECT_TRUE(refusal({"dds=papr"})
                  .starts_with("--set dds=papr: no dds file named 'papr'; did you mean 'paper'?; "
                               "expected one of cyclonedds-0.10, cyclonedds-0.10-multicast, "))
      << refusal({"dds=papr"});
  EXPECT_EQ(refusal({"dds.implementation=fastdds"}),
            "--set dds.implementation=fastdds: implementation: 'fastdds'; expected paper, as the "
            "profile that this changes has it; the keys of one do not fit the other");
}

TEST(ScenarioFile, fast_dds_has_fewer_keys) {
  const std::string timers =
      "{heartbeat_period: 1s, heartbeat_response_delay: 1ms, nack_response_delay: 2ms, "
      "nack_suppression_duration: 3ms, initial_acknack_delay: 4ms, heartbeat_policy: adaptive, "
      "adaptive: {min_period: 1ms, max_period: 1s, epsilon: 0.1}, piggyback: off, "
      "piggyback_threshold_bytes: 0}";
  const std::string spdp =
      "{period: 2s, startup_announcements: 1, startup_period: 1ms, resend: none}";
  const Scenario read =
      scenario(plain, {"dds={implementation: fastdds, spdp: " + spdp + ", sedp: " + timers + "}"});
  DdsProfile expected;
  expected.implementation = ImplementationKind::fastdds;
  expected.spdp.period = Nanoseconds{2'000'000'000};
  expected.spdp.startup_announcements = 1;
  expected.spdp.startup_period = Nanoseconds{1'000'000};
  expected.spdp.resend = SpdpResend::none;
  expected.sedp.heartbeat_response_delay = Nanoseconds{1'000'000};
  expected.sedp.nack_response_delay = Nanoseconds{2'000'000};
  expected.sedp.nack_suppression_duration = Nanoseconds{3'000'000};
  expected.sedp.initial_acknack_delay = Nanoseconds{4'000'000};
  expected.sedp.heartbeat_policy = HeartbeatPolicy::adaptive;
  expected.sedp.adaptive = {Nanoseconds{1'000'000}, Nanoseconds{1'000'000'000}, 1, 10};
  expected.sedp.piggyback = Piggyback::off;
  expected.sedp.piggyback_threshold_bytes = Bytes{0};
  EXPECT_EQ(read.dds, expected);
}

TEST(ScenarioFile, the_interval_of_initial_acknacks_doubles_unless_a_file_says_otherwise) {
  using enum InitialAckNackInterval;
  EXPECT_EQ(scenario(plain, {}).dds.sedp.initial_acknack_interval, doubling);
  for (const char* profile : {"dds=paper", "dds=fastdds-2.6.11"}) {
    const auto interval = [&](const std::string& value) {
      return scenario(plain, {profile, "dds.sedp.initial_acknack_interval=" + value})
          .dds.sedp.initial_acknack_interval;
    };
    EXPECT_EQ(interval("constant"), constant);
    EXPECT_EQ(interval("doubling"), doubling);
  }
  EXPECT_EQ(refusal({"dds.sedp.initial_acknack_interval=halving"}),
            "--set dds.sedp.initial_acknack_interval=halving: dds.sedp.initial_acknack_interval: "
            "'halving' is not known; expected one of doubling, constant");
}

TEST(ScenarioFile, a_profile_keeps_the_implementation_of_its_base) {
  const Scenario read = scenario(
      plain, {"dds={base: fastdds-2.6.11, implementation: fastdds, sedp: {piggyback: off}}"});
  EXPECT_EQ(read.dds.implementation, ImplementationKind::fastdds);
  EXPECT_EQ(read.dds.sedp.piggyback, Piggyback::off);
  EXPECT_EQ(
      scenario(plain, {"dds.base=fastdds-3.6", "dds.implementation=fastdds"}).dds.sedp.piggyback,
      Piggyback::group);
  EXPECT_EQ(scenario(plain, {"dds.implementation=paper"}).dds, DdsProfile{});
  EXPECT_EQ(refusal({"dds=fastdds-2.6.11", "dds.sedp.grouping=mtu"}),
            "--set dds.sedp.grouping=mtu: dds.sedp.grouping: only implementation: paper has this "
            "key; expected none of it in a profile with implementation: fastdds");
  const std::vector<std::string> change{"implementation=paper"};
  EXPECT_EQ(to_string(read_dds_profile("fastdds-3.6", change, source_specs()).error()),
            "--set implementation=paper: implementation: 'paper'; expected fastdds, as the profile "
            "that this changes has it; the keys of one do not fit the other");
  EXPECT_NE(read_wireless_profile("wired", change, source_specs())
                .error()
                .message.find("unknown key 'implementation'"),
            std::string::npos);
}

TEST(ScenarioFile, participants_take_their_time) {
  const Scenario read = scenario(
      plain, {"deployment={participants: [{host: 0, publications: 1, subscriptions: 0}, {host: 1, "
              "publications: 1, subscriptions: 0, start: 3ms}, {host: 1, publications: 1, "
              "subscriptions: 0, start: 3ms, endpoints_done: 4ms}], loopback_delay: 0}"});
  const auto& participants = read.deployment.participants;
  EXPECT_EQ(participants[0].endpoints_done, Nanoseconds{0});
  EXPECT_EQ(participants[1].endpoints_done, Nanoseconds{3'000'000});
  EXPECT_EQ(participants[2].endpoints_done, Nanoseconds{4'000'000});
  EXPECT_EQ(read.deployment.loopback_delay, Nanoseconds{0});
  EXPECT_EQ(scenario(plain).deployment.loopback_delay, Nanoseconds{2'000'000});
  EXPECT_EQ(scenario(plain, {"deployment.loopback_delay=60us"}).deployment.loopback_delay,
            Nanoseconds{60'000});
}

TEST(ScenarioFile, a_schedule_is_drawn) {
  Deployment expected = Deployment::homogeneous(2, 1, 3);
  expected.schedule = Schedule{Nanoseconds{3'000'000}, Nanoseconds{30'000'000},
                               Nanoseconds{50'000'000}, Nanoseconds{90'000'000}, 0};
  expected.draw_schedule(18'446'744'073'709'551'615ULL);
  const std::string ranges = "start: [3ms, 30ms], endpoints_done: [50ms, 90ms]";
  const Scenario read =
      scenario(plain, {"deployment.schedule={" + ranges + ", seed: 18446744073709551615}"});
  EXPECT_EQ(read.deployment, expected);
  EXPECT_GT(read.deployment.participants[0].start, Nanoseconds{3'000'000});

  expected.draw_schedule(0);
  EXPECT_EQ(scenario(plain, {"deployment.schedule={" + ranges + "}"}).deployment, expected);
  EXPECT_NE(read.deployment, expected);
  // The list form draws as well, for participants that differ.
  EXPECT_EQ(scenario(plain, {"deployment={participants: [{host: 0, publications: 2, subscriptions: "
                             "1}, {host: 1, publications: 2, subscriptions: 1}], schedule: {" +
                             ranges + "}}"})
                .deployment,
            expected);
}

TEST(ScenarioFile, ranges_of_a_schedule_have_defaults) {
  const auto schedule = [](const std::string& text) {
    return *scenario(plain, {"deployment.schedule=" + text}).deployment.schedule;
  };
  const Nanoseconds one{1'000'000};
  const Nanoseconds two{2'000'000};
  const Nanoseconds zero{0};
  EXPECT_EQ(schedule("{}"), Schedule{});
  EXPECT_EQ(schedule("{start: [1ms, 2ms]}"), (Schedule{one, two, one, two, 0}));
  EXPECT_EQ(schedule("{endpoints_done: [1ms, 2ms], seed: 5}"), (Schedule{zero, zero, one, two, 5}));
  EXPECT_EQ(schedule("{start: [2ms, 2ms], endpoints_done: [0, 1ms]}"),
            (Schedule{two, two, zero, one, 0}));
  const Scenario late =
      scenario(plain, {"deployment.schedule={start: [2ms, 2ms], endpoints_done: [0, 1ms]}"});
  EXPECT_EQ(late.deployment.participants[1].endpoints_done, two);
}

TEST(ScenarioFile, a_schedule_says_how_long_before_their_starts_participants_hear) {
  const Scenario read =
      scenario(plain, {"deployment.schedule={start: [2ms, 9ms], open_before: 3ms}"});
  for (const Participant& participant : read.deployment.participants) {
    const Nanoseconds before = participant.start - Nanoseconds{3'000'000};
    EXPECT_EQ(participant.open, std::max(before, Nanoseconds{0}));
  }
  Deployment other = read.deployment;
  other.draw_schedule(7);
  EXPECT_EQ(other.participants[1].open,
            std::max(other.participants[1].start - Nanoseconds{3'000'000}, Nanoseconds{0}));
  EXPECT_FALSE(
      scenario(plain, {"deployment.schedule={start: [2ms, 9ms]}"}).deployment.participants[0].open);
}

TEST(ScenarioFile, an_override_can_choose_another_seed) {
  const Scenario first = scenario(plain, {"deployment.schedule={start: [0, 1s]}"});
  const Scenario second =
      scenario(plain, {"deployment.schedule={start: [0, 1s]}", "deployment.schedule.seed=1"});
  EXPECT_NE(first.deployment.participants[0].start, second.deployment.participants[0].start);
  EXPECT_EQ(second.deployment.schedule->seed, 1U);
}

TEST(ScenarioFile, profiles_can_be_read_alone) {
  const std::vector<std::string> overrides{"sedp.grouping=mtu"};
  EXPECT_EQ(read_dds_profile("paper", overrides, source_specs())->sedp.grouping, Grouping::mtu);
  EXPECT_EQ(read_wireless_profile(STORMPROOF_SPECS_DIR "/wireless/wired.yaml", {}, source_specs())
                ->one_way,
            Nanoseconds{100'000});
  EXPECT_EQ(to_string(read_dds_profile("nope.yaml", {}, source_specs()).error()),
            "nope.yaml: no file 'nope.yaml'; looked for nope.yaml");
}

TEST(ScenarioFile, scenarios_go_by_path_or_name) {
  const TestFiles files{};
  const std::string path = files.write("mine.yaml", plain);
  EXPECT_EQ(read_scenario(path, {}, source_specs())->deployment.size(), 2U);
  EXPECT_EQ(read_scenario("wifi-5x20", {}, source_specs())->deployment,
            Deployment::homogeneous(2, 5, 20));
  EXPECT_FALSE(read_scenario("wifi", {}, source_specs()));
}

TEST(ScenarioFile, profiles_are_found_beside_the_scenario) {
  const TestFiles files{};
  files.write("radio.yaml", "{base: wifi-80211n, rate_unicast: 1Gbps}");
  const std::string text = "{base: radio.yaml, order: fifo}";
  std::string own = plain;
  own.replace(own.find("wifi-80211n"), 11, text);
  const auto read = read_scenario(files.write("own.yaml", own), {}, source_specs());
  ASSERT_TRUE(read) << to_string(read.error());
  EXPECT_EQ(read->wireless.rate_unicast, BitsPerSecond{1'000'000'000});
  EXPECT_EQ(read->wireless.order, ServiceOrder::fifo);
}

TEST(ScenarioFile, packet_delays_are_sorted_by_packet) {
  const std::string text =
      "deployment: {hosts: 2, participants_per_host: 1, endpoints_per_participant: 2}\n"
      "dds: paper\n"
      "wireless: {kind: constant_delay, one_way: 1ms, packet_delays: [{packet: 5, one_way: 2ms}, "
      "{packet: 0, leaves_after: 3us, one_way: 1s}]}\n"
      "time_limit: 5s\n"
      "run_until: time_limit\n";
  const auto read = parse_scenario(text, "f", {}, source_specs());
  ASSERT_TRUE(read) << to_string(read.error());
  const std::vector<PacketDelay> expected{{0, Nanoseconds{3'000}, Nanoseconds{1'000'000'000}},
                                          {5, Nanoseconds{0}, Nanoseconds{2'000'000}}};
  EXPECT_EQ(read->wireless.packet_delays, expected);
  EXPECT_EQ(read->run_until, RunUntil::time_limit);
  const std::vector<std::string> changes{"wireless.packet_delays=[]", "run_until=completion"};
  const auto changed = parse_scenario(text, "f", changes, source_specs());
  ASSERT_TRUE(changed) << to_string(changed.error());
  EXPECT_TRUE(changed->wireless.packet_delays.empty());
  EXPECT_EQ(changed->run_until, RunUntil::completion);
}

}  // namespace scenario_file_test
}  // namespace stormproof::model::config
