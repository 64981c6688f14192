// What is written as JSON or YAML reads back as the same scenario.
#include "model/config/knobs/effective.hpp"

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>
#include <rapidcheck/gtest.h>

#include "model/config/scenario_file.hpp"
#include "tests/model/config/test_files.hpp"

namespace stormproof::model::config {
namespace effective_test {

/// The scenario that `text` describes, without any spec folder: an effective scenario refers to no
/// file.
Result<Scenario> read_back(const std::string& text) {
  return parse_scenario(text, "effective", {}, SpecPath{});
}

void expect_round_trip(const Scenario& scenario) {
  for (const std::string& text : {effective_json(scenario).dump(), effective_json(scenario).dump(2),
                                  effective_yaml(scenario)}) {
    const auto again = read_back(text);
    ASSERT_TRUE(again) << to_string(again.error()) << "\n" << text;
    EXPECT_EQ(*again, scenario) << text;
  }
}

TEST(Effective, every_scenario_of_the_source_tree_survives) {
  const SpecPath specs = source_specs();
  for (const std::string& name : specs.names(SpecKind::scenarios)) {
    for (const std::string& wireless : specs.names(SpecKind::wireless)) {
      const std::vector<std::string> overrides{"wireless=" + wireless};
      const auto scenario = read_scenario(name, overrides, specs);
      const auto shipped = read_scenario(name, {}, specs);
      const auto channel = read_wireless_profile(wireless, {}, specs);
      const bool is_paper = shipped->dds.implementation == ImplementationKind::paper;
      // Units are not the paper's, and no life is known over a sender that stalls.
      const bool fits = (channel->service != ServedBy::unit || !is_paper) &&
                        (channel->sender != Sender::stalls || !shipped->deployment.life ||
                         shipped->dds.amendments.has_value());
      ASSERT_EQ(static_cast<bool>(scenario), fits) << name << " over " << wireless;
      if (scenario) expect_round_trip(*scenario);
    }
  }
}

TEST(Effective, names_that_look_like_something_else_survive) {
  Scenario scenario;
  scenario.deployment = Deployment::homogeneous(2, 1, 2);
  for (const char* name :
       {"5",  "null", "~",        "true", "a: b", "# x",  "\"q\"", "'", "-", "[x]", "&a",
        "*a", "ä😀",   " padded ", "0x10", "1e3",  "a\\b", "%",     "@", "{", "no",  "10us"}) {
    scenario.wireless.stages[0].name = name;
    scenario.wireless.stages[1].channel = name;
    expect_round_trip(scenario);
  }
}

TEST(Effective, what_the_model_has_not_got_survives) {
  Scenario scenario;
  scenario.deployment = Deployment::homogeneous(2, 1, 2);
  for (const char* key :
       {"5",  "null",      "~",   "a: b",     "# x", "\"q\"", "'", "-", "- x", "[x]", "&a",
        "*a", "a/b[@max]", "x.y", " padded ", "ä😀",  "a\\b",  "@", "{", "?",   "<<",  "|"}) {
    scenario.dds.unmodelled[key] = std::string{key} + ": 5 # no comment";
  }
  expect_round_trip(scenario);
}

RC_GTEST_PROP(Effective, numbers_survive, ()) {
  const auto up_to = [](std::int64_t least, std::int64_t most) {
    return *rc::gen::inRange<std::int64_t>(least, most + 1);
  };
  Scenario scenario;
  scenario.deployment = Deployment::homogeneous(2, 1, 3);
  Participant& first = scenario.deployment.participants[0];
  first.start = Nanoseconds{up_to(0, 1'000'000'000'000'000)};
  first.endpoints_done = Nanoseconds{up_to(first.start.count(), 1'000'000'000'000'000)};
  scenario.deployment.loopback_delay = Nanoseconds{up_to(0, 1'000'000'000'000'000)};
  scenario.dds.sedp.heartbeat_period = Nanoseconds{up_to(1, 1'000'000'000'000'000)};
  scenario.dds.sedp.piggyback_threshold_bytes = Bytes{up_to(0, 1'000'000'000'000)};
  scenario.wireless.rate_unicast = BitsPerSecond{up_to(1, 1'000'000'000'000'000)};
  scenario.wireless.stages[1].overhead_multicast = Nanoseconds{up_to(0, 1'000'000'000'000'000)};
  scenario.wireless.lost_packets = {static_cast<std::uint64_t>(up_to(0, 1'000'000'000'000'000))};
  scenario.time_limit = Nanoseconds{up_to(1, 1'000'000'000'000'000)};
  const auto from_json = read_back(effective_json(scenario).dump());
  const auto from_yaml = read_back(effective_yaml(scenario));
  RC_ASSERT((from_json && *from_json == scenario));
  RC_ASSERT((from_yaml && *from_yaml == scenario));
}

RC_GTEST_PROP(Effective, drawn_times_survive_with_their_schedule, (std::uint64_t seed)) {
  const auto range = [](Nanoseconds& low, Nanoseconds& high) {
    low = Nanoseconds{*rc::gen::inRange<std::int64_t>(0, 1'000'000'000'000'001)};
    high = Nanoseconds{*rc::gen::inRange<std::int64_t>(low.count(), 1'000'000'000'000'001)};
  };
  Scenario scenario;
  scenario.dds.implementation = ImplementationKind::fastdds;
  scenario.deployment = Deployment::homogeneous(2, 3, 3);
  Schedule& schedule = scenario.deployment.schedule.emplace();
  range(schedule.start_min, schedule.start_max);
  range(schedule.endpoints_done_min, schedule.endpoints_done_max);
  if (*rc::gen::arbitrary<bool>()) {
    schedule.open_before = Nanoseconds{*rc::gen::inRange<std::int64_t>(0, 1'000'000'000'000'001)};
  }
  scenario.deployment.draw_schedule(seed);
  const auto from_json = read_back(effective_json(scenario).dump());
  const auto from_yaml = read_back(effective_yaml(scenario));
  RC_ASSERT((from_json && *from_json == scenario));
  RC_ASSERT((from_yaml && *from_yaml == scenario));
}

TEST(Effective, packet_delays_and_the_end_of_the_run_survive) {
  Scenario scenario;
  scenario.deployment = Deployment::homogeneous(2, 1, 2);
  scenario.wireless.kind = ServiceKind::constant_delay;
  scenario.wireless.packet_delays = {{0, Nanoseconds{0}, Nanoseconds{0}},
                                     {3, Nanoseconds{17}, Nanoseconds{17}},
                                     {1'000'000'000'000'000, Nanoseconds{1}, Nanoseconds{1'500}}};
  scenario.run_until = RunUntil::time_limit;
  expect_round_trip(scenario);
  const auto json = effective_json(scenario);
  EXPECT_EQ(json["wireless"]["packet_delays"][1].dump(),
            R"({"packet":3,"leaves_after":"17ns","one_way":"17ns"})");
  EXPECT_EQ(json["run_until"], "time_limit");
}

TEST(Effective, no_packet_delays_and_the_usual_end_are_left_out) {
  Scenario scenario;
  scenario.deployment = Deployment::homogeneous(2, 1, 2);
  scenario.wireless.kind = ServiceKind::constant_delay;
  const auto json = effective_json(scenario);
  EXPECT_FALSE(json["wireless"].contains("packet_delays"));
  EXPECT_FALSE(json.contains("run_until"));
  expect_round_trip(scenario);
}

TEST(Effective, every_dds_profile_survives) {
  const SpecPath specs = source_specs();
  for (const std::string& name : specs.names(SpecKind::dds)) {
    for (const char* scenario : {"wifi-5x20", "live-5x20"}) {
      const std::vector<std::string> overrides{"dds=" + name};
      expect_round_trip(*read_scenario(scenario, overrides, specs));
    }
  }
}

TEST(Effective, fast_dds_has_only_its_keys) {
  const auto keys = [](const nlohmann::ordered_json& map) {
    std::vector<std::string> names;
    for (const auto& [key, value] : map.items()) names.push_back(key);
    return names;
  };
  const auto json = effective_json(*read_dds_profile("fastdds-2.6.11", {}, source_specs()));
  EXPECT_EQ(keys(json), (std::vector<std::string>{"implementation", "spdp", "sedp"}));
  EXPECT_EQ(keys(json["spdp"]), (std::vector<std::string>{"period", "startup_announcements",
                                                          "startup_period", "resend"}));
  EXPECT_EQ(keys(json["sedp"]),
            (std::vector<std::string>{"heartbeat_period", "heartbeat_response_delay",
                                      "nack_response_delay", "nack_suppression_duration",
                                      "initial_acknack_delay", "initial_acknack_interval",
                                      "heartbeat_policy", "adaptive", "grouping_limit_bytes",
                                      "piggyback", "piggyback_threshold_bytes"}));
}

TEST(Effective, a_schedule_stands_beside_the_times_drawn_from_it) {
  const std::vector<std::string> overrides{"deployment.schedule={start: [1ms, 1ms], seed: 7}"};
  const auto scenario = read_scenario("smallest", overrides, source_specs());
  ASSERT_TRUE(scenario) << to_string(scenario.error());
  const auto json = effective_json(*scenario);
  EXPECT_EQ(json["deployment"]["schedule"].dump(),
            R"({"start":["1ms","1ms"],"endpoints_done":["1ms","1ms"],"seed":7})");
  EXPECT_EQ(
      json["deployment"]["participants"][1].dump(),
      R"({"host":1,"publications":1,"subscriptions":1,"start":"1ms","endpoints_done":"1ms"})");
}

TEST(Effective, the_form_is_that_of_a_scenario_file) {
  Scenario scenario;
  scenario.deployment = Deployment::homogeneous(2, 1, 1);
  scenario.wireless.source_queue_bytes = WirelessProfile::unlimited;
  const auto json = effective_json(scenario);
  EXPECT_EQ(json["deployment"]["participants"][1].dump(),
            R"({"host":1,"publications":1,"subscriptions":0,"start":"0s","endpoints_done":"0s"})");
  EXPECT_EQ(json["deployment"]["loopback_delay"], "2ms");
  EXPECT_FALSE(json["deployment"].contains("schedule"));
  EXPECT_EQ(json["dds"]["sedp"]["nack_response_delay"], "100us");
  EXPECT_EQ(json["dds"]["sedp"]["adaptive"]["epsilon"], "1/20");
  EXPECT_EQ(json["wireless"]["source_queue_bytes"], "unlimited");
  EXPECT_EQ(json["wireless"]["rate_unicast"], "144.4Mbps");
  EXPECT_FALSE(json["wireless"]["stages"][0].contains("rate_unicast"));
  EXPECT_NE(effective_yaml(scenario).find("\n  sedp:\n    heartbeat_period: 1s\n"),
            std::string::npos);
}

}  // namespace effective_test
}  // namespace stormproof::model::config
