// One bad input a line: the text, the line and column of the error, and what its message has to
// say. `good` is a complete scenario with complete profiles in it; most inputs are that scenario
// with one piece replaced.
#include <fmt/core.h>
#include <gtest/gtest.h>

#include "model/config/knobs/effective.hpp"
#include "model/config/scenario_file.hpp"
#include "tests/model/config/test_files.hpp"

namespace stormproof::model::config {
namespace bad_input_test {

const std::string good =
    R"(deployment: {hosts: 2, participants_per_host: 5, endpoints_per_participant: 20}
dds:
  spdp:
    period: 3s
    startup_announcements: 5
    startup_period: 100ms
    resend: all_known
    payload_bytes: 420
  sedp:
    heartbeat_period: 1s
    heartbeat_response_delay: 10us
    nack_response_delay: 100us
    nack_suppression_duration: 10us
    initial_acknack_delay: 70ms
    relation_opening: receiver
    initial_data: push
    unmatched: drop
    initial_acknack: bitmap
    acknowledge: bitmap
    heartbeat_timer: single
    heartbeat_recipients: unacknowledged
    heartbeat_policy: periodic
    adaptive: {min_period: 100ms, max_period: 3s, epsilon: 0.05}
    grouping: message
    grouping_limit_bytes: 65500
    piggyback: cumulative
    piggyback_threshold_bytes: 106496
    heartbeat_bytes: 68
    acknack_bytes: 64
    piggyback_heartbeat_bytes: 32
    shared_header_bytes: 36
  descriptors:
    default_publications: 9
    default_subscriptions: 8
    default_bytes: [452, 532]
    user_bytes: 460
wireless:
  kind: shared_channel
  overhead_unicast: 194.5us
  overhead_multicast: 130.5us
  rate_unicast: 144.4Mbps
  rate_multicast: 6Mbps
  link_overhead_bytes: 38
  mtu_payload_bytes: 1480
  source_queue_bytes: 212992
  order: fifo_uplink
  fragment_request: sequential
  stages:
    - {name: uplink, channel: air, multicast_as: unicast}
    - {name: downlink, channel: air, multicast_as: multicast}
time_limit: 200s
)";

struct BadInput {
  const char* name;
  std::string text;
  int line, column;
  const char* expectation;  ///< part of the message
};

/// `good` with `piece` replaced by `replacement`.
std::string with(const std::string& piece, const std::string& replacement) {
  const std::size_t at = good.find(piece);
  if (at == std::string::npos) throw std::logic_error{"not in the good scenario: " + piece};
  std::string text = good;
  return text.replace(at, piece.size(), replacement);
}

std::string with_deployment(const std::string& value) {
  return with("{hosts: 2, participants_per_host: 5, endpoints_per_participant: 20}", value);
}

std::string two(const std::string& participant) {
  return with_deployment("{participants: [{host: 0, publications: 1, subscriptions: 1}, " +
                         participant + "]}");
}

std::string with_schedule(const std::string& schedule) {
  return with("endpoints_per_participant: 20",
              "endpoints_per_participant: 20, schedule: " + schedule);
}

/// Two participants, the second with these times, and a schedule in which both start at 1 ms and
/// are done at 2 ms.
std::string scheduled(const std::string& times) {
  return with_deployment(
      "{schedule: {start: [1ms, 1ms], endpoints_done: [2ms, 2ms]}, participants: [{host: 0, "
      "publications: 1, subscriptions: 1}, {host: 1, publications: 1, subscriptions: 1" +
      times + "}]}");
}

/// A scenario with a complete profile of Fast DDS in one line, with `spdp`, `sedp` and `rest` put
/// at the end of its maps.
std::string fastdds(const std::string& spdp, const std::string& sedp, const std::string& rest) {
  return "{deployment: {hosts: 2, participants_per_host: 1, endpoints_per_participant: 2},\n"
         "dds: {implementation: fastdds,\n"
         "spdp: {period: 3s, startup_announcements: 5, startup_period: 1s, resend: none,\n" +
         spdp +
         "}, sedp: {heartbeat_period: 1s, heartbeat_response_delay: 1ms, nack_response_delay: 1ms, "
         "nack_suppression_duration: 1ms, initial_acknack_delay: 1ms, heartbeat_policy: periodic, "
         "adaptive: {min_period: 1s, max_period: 1s, epsilon: 1}, piggyback: off, "
         "piggyback_threshold_bytes: 1,\n" +
         sedp + "},\n" + rest + "}, wireless: {kind: constant_delay, one_way: 0}, time_limit: 1s}";
}

void PrintTo(const BadInput& input, std::ostream* out) { *out << input.name; }

class BadInputs : public testing::TestWithParam<BadInput> {};

TEST_P(BadInputs, is_refused_at_its_place) {
  const BadInput& input = GetParam();
  const auto read = parse_scenario(input.text, "bad.yaml", {}, source_specs());
  ASSERT_FALSE(read);
  EXPECT_EQ(read.error().where, fmt::format("bad.yaml:{}:{}", input.line, input.column))
      << read.error().message;
  EXPECT_NE(read.error().message.find(input.expectation), std::string::npos)
      << read.error().message;
}

std::string name_of_case(const testing::TestParamInfo<BadInput>& info) { return info.param.name; }

const char* const duration = "expected a duration from 0s to 1000000s";
const char* const period = "expected a duration from 1ns to 1000000s";
const char* const a_rate = "expected a rate from 1bps to 1000000Gbps";

INSTANTIATE_TEST_SUITE_P(
    Form, BadInputs,
    testing::Values(
        BadInput{"empty", "", 1, 1, "nothing in it"},  //
        BadInput{"only_a_comment", "# nothing\n", 1, 1, "nothing in it"},
        BadInput{"a_list", "- 1\n", 1, 1, "a list is not a map; expected the keys deployment, dds"},
        BadInput{"a_word", "\n  scenario\n", 2, 3, "'scenario' is not a map; expected the keys"},
        BadInput{"syntax", with("{name: uplink,", "{name: uplink, ]"), 49, 22, "not valid YAML"},
        BadInput{"duplicate", good + "time_limit: 5s\n", 52, 1, "key 'time_limit' is given twice"},
        BadInput{"two_documents", good + "---\nx: 1\n", 53, 1, "a second document"},
        BadInput{"tag", with("period: 3s", "period: !special 3s"), 4, 13,
                 "tag '!special' is not known"},
        BadInput{"unknown_key", good + "timelimit: 5s\n", 52, 1,
                 "unknown key 'timelimit'; did you mean 'time_limit'?"},
        BadInput{"far_key", good + "x: 5s\n", 52, 1,
                 "unknown key 'x'; expected one of deployment, dds, wireless, hosts, time_limit, "
                 "run_until"},
        BadInput{"run_until", with("time_limit: 200s", "time_limit: 200s\nrun_until: forever"), 52,
                 12, "run_until: 'forever' is not known; expected one of completion, time_limit"},
        BadInput{"description", "description: [1]\n" + good, 1, 14,
                 "description: a list; expected text"},
        BadInput{"no_deployment", "dds: paper\nwireless: wired\ntime_limit: 1s\n", 1, 1,
                 "missing key 'deployment'; expected a map"},
        BadInput{"no_dds",
                 "deployment: {hosts: 2, participants_per_host: 1, endpoints_per_participant: 2}\n",
                 1, 1, "missing key 'dds'"},
        BadInput{"no_time_limit", with("time_limit: 200s", ""), 1, 1, "missing key 'time_limit'"},
        BadInput{"time_limit_zero", with("200s", "0"), 51, 13, period},
        BadInput{"time_limit_no_unit", with("200s", "200"), 51, 13,
                 "'200' has no unit (ns, us, ms, s)"},
        BadInput{"time_limit_null", with("200s", ""), 51, 1, "nothing is not a number"}),
    name_of_case);

INSTANTIATE_TEST_SUITE_P(
    InDeployment, BadInputs,
    testing::Values(
        BadInput{"no_form", with_deployment("{}"), 1, 13, "missing key 'hosts' in deployment"},
        BadInput{"text", with_deployment("wifi"), 1, 13,
                 "deployment: 'wifi' is not a map; expected the keys hosts"},
        BadInput{"both_forms", with_deployment("{hosts: 2, participants: []}"), 1, 14,
                 "deployment.hosts: not together with participants"},
        BadInput{"misspelt", with_deployment("{host: 2}"), 1, 14, "did you mean 'hosts'?"},
        BadInput{
            "one_host",
            with_deployment("{hosts: 1, participants_per_host: 5, endpoints_per_participant: 2}"),
            1, 13, "participants on at least two hosts"},
        BadInput{"a_billion_hosts",
                 with_deployment(
                     "{hosts: 1000000000, participants_per_host: 1, endpoints_per_participant: 2}"),
                 1, 21, "'1000000000' is out of range; expected an integer from 1 to 4000"},
        BadInput{"too_many_in_all",
                 with_deployment(
                     "{hosts: 4000, participants_per_host: 4000, endpoints_per_participant: 2}"),
                 1, 50, "at most 4000 participants in all"},
        BadInput{"too_many_endpoints",
                 with_deployment(
                     "{hosts: 2, participants_per_host: 1, endpoints_per_participant: 100001}"),
                 1, 77, "expected an integer from 0 to 100000"},
        BadInput{"hosts_overflow",
                 with_deployment("{hosts: 99999999999999999999, participants_per_host: 1, "
                                 "endpoints_per_participant: 2}"),
                 1, 21, "is too large; expected an integer from 1 to 4000"},
        BadInput{"hosts_in_quotes", with("hosts: 2", "hosts: '2'"), 1, 21, "'2' in quotes is text"},
        BadInput{"hosts_fraction", with("hosts: 2", "hosts: 2.5"), 1, 21,
                 "not an integer in plain decimal digits"},
        BadInput{"empty_list", with_deployment("{participants: []}"), 1, 28,
                 "a list of 0; expected a list of 1"},
        BadInput{"not_a_list", with_deployment("{participants: 3}"), 1, 28, "'3' is not a list"},
        BadInput{"participant_no_map", two("5"), 1, 75,
                 "deployment.participants.1: '5' is not a map; expected the keys host"},
        BadInput{
            "participant_key", two("{host: 1, publication: 1, subscriptions: 1}"), 1, 85,
            "unknown key 'publication' in deployment.participants.1; did you mean 'publications'?"},
        BadInput{"participant_missing", two("{host: 1, publications: 1}"), 1, 75,
                 "missing key 'subscriptions' in deployment.participants.1"},
        BadInput{"negative_start", two("{host: 1, publications: 1, subscriptions: 1, start: -1ms}"),
                 1, 127, "'-1ms' is negative"},
        BadInput{"same_host", two("{host: 0, publications: 1, subscriptions: 1}"), 1, 13,
                 "participants on at least two hosts"},
        BadInput{"done_before_start",
                 two("{host: 1, publications: 1, subscriptions: 1, start: 2ms, endpoints_done: "
                     "1.9ms}"),
                 1, 148,
                 "deployment.participants.1.endpoints_done: '1.9ms'; expected at least its start "
                 "of 2ms"},
        BadInput{"loopback_no_unit",
                 with("participants_per_host: 5", "participants_per_host: 5, loopback_delay: 60"),
                 1, 66, "deployment.loopback_delay: '60' has no unit"},
        BadInput{"loopback_negative",
                 with("participants_per_host: 5", "participants_per_host: 5, loopback_delay: -1ms"),
                 1, 66, "'-1ms' is negative"},
        BadInput{"host_number", two("{host: 4000, publications: 1, subscriptions: 1}"), 1, 82,
                 "expected an integer from 0 to 3999"}),
    name_of_case);

INSTANTIATE_TEST_SUITE_P(
    InSchedule, BadInputs,
    testing::Values(
        BadInput{"text", with_schedule("late"), 1, 91,
                 "deployment.schedule: 'late' is not a map; expected the keys start, "
                 "endpoints_done, open_before, seed"},
        BadInput{"unknown_key", with_schedule("{begin: [0, 1s]}"), 1, 92,
                 "unknown key 'begin' in deployment.schedule"},
        BadInput{"not_a_range", with_schedule("{start: 3ms}"), 1, 99,
                 "deployment.schedule.start: '3ms' is not a list; expected [low, high]"},
        BadInput{"three", with_schedule("{start: [0, 1s, 2s]}"), 1, 99, "a list of 3"},
        BadInput{"no_unit", with_schedule("{start: [3, 30]}"), 1, 100, "'3' has no unit"},
        BadInput{"negative", with_schedule("{endpoints_done: [-1s, 30s]}"), 1, 109, "is negative"},
        BadInput{"backwards", with_schedule("{start: [30ms, 3ms]}"), 1, 99,
                 "deployment.schedule.start: '30ms' is more than '3ms'; expected [low, high]"},
        BadInput{"seed_negative", with_schedule("{seed: -1}"), 1, 98, "'-1' is negative"},
        BadInput{"seed_large", with_schedule("{seed: 18446744073709551616}"), 1, 98,
                 "is too large; expected an integer from 0 to 18446744073709551615"},
        BadInput{"other_start", scheduled(", start: 2ms"), 1, 186,
                 "deployment.participants.1.start: '2ms'; expected 1ms, which the schedule draws, "
                 "or no start at all"},
        BadInput{
            "other_endpoints_done", scheduled(", start: 1ms, endpoints_done: 1ms"), 1, 207,
            "deployment.participants.1.endpoints_done: '1ms'; expected 2ms, which the schedule "
            "draws"}),
    name_of_case);

const char* const of_paper =
    ": only implementation: paper has this key; expected none of it in a profile with "
    "implementation: fastdds";

INSTANTIATE_TEST_SUITE_P(
    InFastDds, BadInputs,
    testing::Values(
        BadInput{"spdp_size", fastdds("payload_bytes: 252", "", ""), 4, 1, of_paper},
        BadInput{"relation_rule", fastdds("", "acknowledge: prefix", ""), 5, 1,
                 "dds.sedp.acknowledge: only implementation: paper has this key"},
        BadInput{"grouping", fastdds("", "grouping: message", ""), 5, 1, of_paper},
        BadInput{"size", fastdds("", "heartbeat_bytes: 68", ""), 5, 1, of_paper},
        BadInput{"descriptors", fastdds("", "", "descriptors: {}"), 6, 1, of_paper},
        BadInput{"unknown_key", fastdds("", "acknowledged: prefix", ""), 5, 1,
                 "unknown key 'acknowledged' in dds.sedp; expected one of heartbeat_period, "
                 "heartbeat_response_delay, nack_response_delay, nack_suppression_duration, "
                 "initial_acknack_delay, initial_acknack_interval, heartbeat_policy, adaptive, "
                 "grouping_limit_bytes, piggyback, piggyback_threshold_bytes"},
        BadInput{"missing",
                 "{deployment: {hosts: 2, participants_per_host: 1, "
                 "endpoints_per_participant: 2},\n dds: {implementation: fastdds}}",
                 2, 7, "missing key 'spdp' in dds; expected a map"}),
    name_of_case);

INSTANTIATE_TEST_SUITE_P(
    InDds, BadInputs,
    testing::Values(
        BadInput{"no_unit", with("period: 3s", "period: 3"), 4, 13,
                 "dds.spdp.period: '3' has no unit"},
        BadInput{"zero_period", with("period: 3s", "period: 0"), 4, 13, period},
        BadInput{"unknown_unit", with("period: 3s", "period: 3min"), 4, 13, "unknown unit 'min'"},
        BadInput{"half_nanosecond", with("10us", "0.5ns"), 11, 31,
                 "'0.5ns' is not a whole number of ns"},
        BadInput{"too_long", with("70ms", "1000001s"), 14, 28, duration},
        BadInput{"overflow", with("70ms", "9999999999999s"), 14, 28, "is too large"},
        BadInput{"count_with_unit", with("announcements: 5", "announcements: 5s"), 5, 28,
                 "expected an integer from 0"},
        BadInput{"choice", with("all_known", "all_know"), 7, 13,
                 "'all_know' is not known; did you mean 'all_known'?"},
        BadInput{"choice_list", with("push", "[push]"), 16, 19,
                 "a list is not a word; expected one of push, pull"},
        BadInput{"choice_far", with("piggyback: cumulative", "piggyback: 7"), 26, 16,
                 "expected one of cumulative, linear, off"},
        BadInput{"missing", with("    grouping: message\n", ""), 10, 5,
                 "missing key 'grouping' in dds.sedp"},
        BadInput{
            "section_missing",
            with("heartbeat_policy: periodic\n    adaptive: {min_period: 100ms, max_period: 3s, "
                 "epsilon: 0.05}",
                 "heartbeat_policy: periodic"),
            10, 5, "missing key 'adaptive' in dds.sedp; expected a map"},
        BadInput{
            "section_scalar",
            with("adaptive: {min_period: 100ms, max_period: 3s, epsilon: 0.05}", "adaptive: on"),
            23, 15,
            "dds.sedp.adaptive: 'on' is not a map; expected the keys min_period, max_period, "
            "epsilon"},
        BadInput{"crossed_periods", with("100ms, max", "4s, max"), 23, 28,
                 "a period that does not exceed max_period"},
        BadInput{"epsilon_zero", with("0.05", "0"), 23, 60, "'0' is not greater than 0"},
        BadInput{"epsilon_large", with("0.05", "1.5"), 23, 60, "greater than 0 and at most 1"},
        BadInput{"epsilon_fine", with("0.05", "1/1001"), 23, 60,
                 "reduced denominator of at most 1000"},
        BadInput{"size_zero", with("65500", "0"), 25, 27,
                 "expected a number of bytes from 1 to 1000000000"},
        BadInput{"small_descriptor", with("user_bytes: 460", "user_bytes: 36"), 36, 17,
                 "dds.descriptors.user_bytes: '36'; expected more than the 36 bytes of "
                 "shared_header_bytes"},
        BadInput{"small_default", with("[452, 532]", "[452, 36]"), 35, 20,
                 "more than the 36 bytes"},
        BadInput{"pair_of_three", with("[452, 532]", "[1, 2, 3]"), 35, 20,
                 "a list of 3; expected [first, last]"},
        BadInput{"pair_of_words", with("[452, 532]", "[452, big]"), 35, 26,
                 "'big' is not an integer"},
        BadInput{"implementation", with("dds:\n", "dds:\n  implementation: fast-dds\n"), 3, 19,
                 "'fast-dds' is not known; did you mean 'fastdds'?"},
        BadInput{"other_implementation", with("dds:\n", "dds:\n  implementation: fastdds\n"), 33, 3,
                 "dds.descriptors: only implementation: paper has this key; expected none of it in "
                 "a profile with implementation: fastdds"},
        BadInput{"base_of_other_implementation",
                 with("dds:\n", "dds:\n  base: paper\n  implementation: fastdds\n"), 4, 19,
                 "implementation: 'fastdds'; expected paper, as the profile that this changes has "
                 "it"},
        BadInput{"base_of_the_other_kind", with("dds:\n", "dds:\n  base: fastdds-2.6.11\n"), 33, 3,
                 "dds.descriptors: only implementation: paper has this key"},
        BadInput{"base_unknown", with("dds:\n", "dds:\n  base: papper\n"), 3, 9,
                 "no dds file named 'papper'; did you mean 'paper'?"},
        BadInput{"base_path", with("dds:\n", "dds:\n  base: no/such.yaml\n"), 3, 9,
                 "no file 'no/such.yaml'"},
        BadInput{"base_list", with("dds:\n", "dds:\n  base: [paper]\n"), 3, 9,
                 "expected a name, a path or a map"},
        BadInput{"wireless_key", with("  spdp:\n", "  stages: []\n  spdp:\n"), 3, 3,
                 "unknown key 'stages' in dds"}),
    name_of_case);

INSTANTIATE_TEST_SUITE_P(
    InWireless, BadInputs,
    testing::Values(
        BadInput{"rate_zero", with("6Mbps", "0bps"), 42, 19, a_rate},
        BadInput{"rate_no_unit", with("6Mbps", "6"), 42, 19,
                 "'6' has no unit (bps, kbps, Mbps, Gbps)"},
        BadInput{"rate_time", with("6Mbps", "6ms"), 42, 19, "unknown unit 'ms'"},
        BadInput{"rate_fraction", with("6Mbps", "0.5bps"), 42, 19,
                 "'0.5bps' is not a whole number of bps"},
        BadInput{"mtu_zero", with("1480", "0"), 44, 22, "from 1 to 1000000000"},
        BadInput{"mtu_huge", with("1480", "1000000001"), 44, 22, "'1000000001' is out of range"},
        BadInput{"overhead_huge", with("bytes: 38", "bytes: 100000001"), 43, 24,
                 "from 0 to 100000000"},
        BadInput{"queue_zero", with("212992", "0"), 45, 23, "or unlimited"},
        BadInput{"queue_word", with("212992", "infinite"), 45, 23, "'infinite' is not an integer"},
        BadInput{
            "no_stage",
            with(
                "    - {name: uplink, channel: air, multicast_as: unicast}\n    - {name: downlink, "
                "channel: air, multicast_as: multicast}",
                "    []"),
            49, 5, "a list of 0; expected a list of 1 to 32 maps"},
        BadInput{"stage_name", with("name: uplink", "name: ''"), 49, 14,
                 "'' is empty; expected text"},
        BadInput{"stage_missing", with(", multicast_as: unicast", ""), 49, 7,
                 "missing key 'multicast_as' in wireless.stages.0"},
        BadInput{"stage_choice", with("as: unicast", "as: broadcast"), 49, 50,
                 "expected one of unicast, multicast"},
        BadInput{"stage_override", with("as: unicast", "as: unicast, rate_unicast: 5"), 49, 73,
                 "wireless.stages.0.rate_unicast: '5' has no unit"},
        BadInput{"kind", with("shared_channel", "shared"), 38, 9,
                 "expected one of shared_channel, constant_delay"},
        BadInput{"one_way_missing", with("kind: shared_channel", "kind: constant_delay"), 38, 3,
                 "missing key 'one_way' in wireless"},
        BadInput{"lost_negative", with("order:", "lost_packets: [1, -1]\n  order:"), 46, 21,
                 "'-1' is negative"},
        BadInput{"lost_scalar", with("order:", "lost_packets: 4\n  order:"), 46, 17,
                 "'4' is not a list"},
        BadInput{"packet_delays_with_a_channel",
                 with("order:", "packet_delays: [{packet: 0, one_way: 1ms}]\n  order:"), 46, 18,
                 "wireless.packet_delays: a list; expected no such list, or kind: constant_delay"}),
    name_of_case);

/// The good profile of Fast DDS with these packet delays, which stand in line 7.
std::string delays(const std::string& list) {
  std::string text = fastdds("", "", "");
  const std::string key = "one_way: 0";
  return text.replace(text.find(key), key.size(), key + ",\npacket_delays: " + list);
}

INSTANTIATE_TEST_SUITE_P(
    PacketDelays, BadInputs,
    testing::Values(
        BadInput{"delays_scalar", delays("4"), 7, 16,
                 "wireless.packet_delays: '4' is not a list; expected a list of 0 to 1000000 maps"},
        BadInput{"delay_of_nothing", delays("[{one_way: 1ms}]"), 7, 17,
                 "missing key 'packet' in wireless.packet_delays.0"},
        BadInput{"delay_without_one_way", delays("[{packet: 1}]"), 7, 17,
                 "missing key 'one_way' in wireless.packet_delays.0"},
        BadInput{"delay_negative", delays("[{packet: 1, one_way: -1ms}]"), 7, 38,
                 "wireless.packet_delays.0.one_way: '-1ms' is negative"},
        BadInput{"delay_leaves_before", delays("[{packet: 1, leaves_after: -1ns, one_way: 1ms}]"),
                 7, 43, "wireless.packet_delays.0.leaves_after: '-1ns' is negative"},
        BadInput{"delay_leaves_too_late",
                 delays("[{packet: 1, leaves_after: 1001us, one_way: 1ms}]"), 7, 43,
                 "wireless.packet_delays.0.leaves_after: '1001us'; expected at most the one_way of "
                 "the same packet"},
        BadInput{"delay_given_twice",
                 delays("[{packet: 7, one_way: 1ms}, {packet: 2, one_way: 1ms},\n"
                        "{packet: 7, one_way: 1ms}]"),
                 8, 10,
                 "wireless.packet_delays.2.packet: packet '7' is given twice; expected one entry "
                 "for each packet"},
        BadInput{"delay_unknown_key", delays("[{packet: 1, oneway: 1ms}]"), 7, 29,
                 "unknown key 'oneway' in wireless.packet_delays.0; did you mean 'one_way'?"}),
    name_of_case);

TEST(BadInput, the_good_scenario_is_good) {
  const auto read = parse_scenario(good, "good.yaml", {}, SpecPath{});
  ASSERT_TRUE(read) << to_string(read.error());
  EXPECT_EQ(read->dds, DdsProfile{});
  EXPECT_EQ(read->wireless, WirelessProfile{});
}

TEST(BadInput, thirty_three_stages_are_too_many) {
  std::string stages;
  for (int k = 0; k < 33; ++k) stages += "{name: a, channel: b, multicast_as: unicast}, ";
  const auto read = parse_scenario(
      "{deployment: {hosts: 2, participants_per_host: 1, endpoints_per_participant: 2}, dds: "
      "paper, wireless: {base: "
      "wifi-80211n, stages: [" +
          stages + "]}, time_limit: 1s}",
      "f", {}, source_specs());
  ASSERT_FALSE(read);
  EXPECT_EQ(read.error().message, "wireless.stages: a list of 33; expected a list of 1 to 32 maps");
}

TEST(BadInput, the_good_profile_of_fast_dds_is_good) {
  const auto read = parse_scenario(fastdds("", "", ""), "good.yaml", {}, SpecPath{});
  ASSERT_TRUE(read) << to_string(read.error());
  const auto drawn = parse_scenario(scheduled(", start: 1ms"), "good.yaml", {}, SpecPath{});
  ASSERT_TRUE(drawn) << to_string(drawn.error());
}

/// The message for the good scenario with these overrides, or "accepted".
std::string refusal(const std::vector<std::string>& overrides) {
  const auto read = parse_scenario(good, "good.yaml", overrides, source_specs());
  return read ? "accepted" : to_string(read.error());
}

TEST(BadInput, a_million_fragments_are_the_limit) {
  const std::string limit = "dds.sedp.grouping_limit_bytes=";
  const std::string mtu = "wireless.mtu_payload_bytes=";
  // The payload carries a HEARTBEAT of 32 B, and the UDP header of 8 B goes with it.
  EXPECT_EQ(refusal({limit + "999960", mtu + "1"}), "accepted");
  EXPECT_EQ(refusal({limit + "999961", mtu + "1"}),
            "--set " + mtu +
                "1: wireless.mtu_payload_bytes: '1'; expected at most 1000000 "
                "fragments a packet; the largest has 999993 bytes of payload "
                "(dds.sedp.grouping_limit_bytes)");
  EXPECT_EQ(refusal({limit + "999992", mtu + "1", "dds.sedp.piggyback=off"}), "accepted");
  EXPECT_EQ(refusal({limit + "999993", mtu + "1", "dds.sedp.grouping=mtu"}), "accepted");
  EXPECT_EQ(refusal({limit + "1000000000", mtu + "1001"}), "accepted");
  EXPECT_EQ(refusal({"dds.descriptors.user_bytes=1000000000"}), "accepted");
  for (const char* key : {"dds.descriptors.user_bytes", "dds.spdp.payload_bytes",
                          "dds.sedp.heartbeat_bytes", "dds.sedp.acknack_bytes"}) {
    const std::string message = refusal({std::string{key} + "=1000000000", mtu + "999"});
    EXPECT_NE(message.find(std::string{"bytes of payload ("} + key), std::string::npos) << message;
  }
  EXPECT_NE(refusal({"dds.descriptors.default_bytes=[452, 1000000000]", mtu + "999"})
                .find("(dds.descriptors.default_bytes)"),
            std::string::npos);
  EXPECT_EQ(refusal({limit + "1000000000", "wireless={kind: constant_delay, one_way: 0}"}),
            "accepted");
  EXPECT_EQ(refusal({mtu + "1", "dds=fastdds-2.6.11"}), "accepted");
}

TEST(BadInput, a_mistake_in_a_base_is_placed_in_that_file) {
  const TestFiles files{};
  const std::string path = files.write("dds/mine.yaml", "base: paper\nsedp:\n  groupin: mtu\n");
  const SpecPath specs{{files.root(), STORMPROOF_SPECS_DIR}};
  const auto read = parse_scenario(
      "{deployment: {hosts: 2, participants_per_host: 1, endpoints_per_participant: 2}, dds: "
      "{base: mine, sedp: "
      "{grouping: single}}, wireless: wired, time_limit: 1s}",
      "f", {}, specs);
  ASSERT_FALSE(read);
  EXPECT_EQ(to_string(read.error()),
            path + ":3:3: unknown key 'groupin' in dds.sedp; did you mean 'grouping'?");
}

/// `good` with a last line; its time limit of 200 s is line 51.
std::string with_last_line(const std::string& line) { return good + line + "\n"; }

INSTANTIATE_TEST_SUITE_P(
    LimitsAndRanges, BadInputs,
    testing::Values(
        BadInput{"limits_scalar", with_last_line("limits: 3s"), 52, 9,
                 "limits: '3s' is not a map; expected the keys completion, messages, "
                 "amplification, backlog"},
        BadInput{"limit_unknown", with_last_line("limits: {completon: 3s}"), 52, 10,
                 "unknown key 'completon' in limits; did you mean 'completion'?"},
        BadInput{"limit_without_unit", with_last_line("limits: {completion: 3}"), 52, 22,
                 "'3' has no unit"},
        BadInput{"limit_zero", with_last_line("limits: {completion: 0}"), 52, 22, period},
        BadInput{"limit_beyond_the_end", with_last_line("limits: {completion: 201s}"), 52, 22,
                 "limits.completion: '201s'; expected at most the time_limit of 200s"},
        BadInput{"limit_messages", with_last_line("limits: {messages: -1}"), 52, 20,
                 "expected an integer from 0 to 1000000000000"},
        BadInput{"limit_amplification_zero", with_last_line("limits: {amplification: 0}"), 52, 25,
                 "'0' is not greater than 0"},
        BadInput{"limit_amplification_large", with_last_line("limits: {amplification: 1000001}"),
                 52, 25, "greater than 0 and at most 1000000"},
        BadInput{"limit_needless_zero", with_last_line("limits: {needless: 0}"), 52, 20,
                 "'0' is not greater than 0"},
        BadInput{"limit_late_zero", with_last_line("limits: {late: 0}"), 52, 16, period},
        BadInput{"limit_backlog", with_last_line("limits: {backlog: 1.5}"), 52, 19,
                 "expected an integer from 0 to"},
        BadInput{"vary_list", with_last_line("vary: [1]"), 52, 7,
                 "expected the keys start_jitter, loss, sizes, delays, timers"},
        BadInput{"vary_unknown", with_last_line("vary: {jitter: 1ms}"), 52, 8,
                 "unknown key 'jitter' in vary"},
        BadInput{"jitter_long", with_last_line("vary: {start_jitter: 1000001s}"), 52, 22, duration},
        BadInput{"loss_zero", with_last_line("vary: {loss: 0}"), 52, 14,
                 "'0' is not greater than 0"},
        BadInput{"loss_large", with_last_line("vary: {loss: 1.01}"), 52, 14,
                 "greater than 0 and at most 1"},
        BadInput{"loss_percent", with_last_line("vary: {loss: 2%}"), 52, 14,
                 "expected a decimal or a fraction"},
        BadInput{"sizes_negative", with_last_line("vary: {sizes: -0.1}"), 52, 15, "vary.sizes: "},
        BadInput{"delays_map", with_last_line("vary: {delays: {a: 1}}"), 52, 16, "is not a number"},
        BadInput{"timers_fine", with_last_line("vary: {timers: 1/1000001}"), 52, 16,
                 "reduced denominator of at most 1000000"}),
    name_of_case);

TEST(LimitsAndRanges, are_read_and_written) {
  const auto read = parse_scenario(
      with_last_line("limits: {completion: 3s, messages: 0, amplification: 2.5, backlog: 7}\n"
                     "vary: {start_jitter: 0, loss: 1/50, sizes: 1, delays: 0.1, timers: 0.25}"),
      "good.yaml", {}, SpecPath{});
  ASSERT_TRUE(read) << to_string(read.error());
  ASSERT_TRUE(read->limits && read->vary);
  EXPECT_EQ(read->limits->completion, Nanoseconds{3'000'000'000});
  EXPECT_EQ(read->limits->messages, 0U);
  EXPECT_EQ(read->limits->amplification, (Ratio{5, 2}));
  EXPECT_EQ(read->limits->backlog, 7U);
  EXPECT_EQ(read->vary->start_jitter, Nanoseconds{0});
  EXPECT_EQ(read->vary->loss, (Ratio{1, 50}));
  EXPECT_EQ(read->vary->sizes, (Ratio{1, 1}));
  EXPECT_EQ(read->vary->delays, (Ratio{1, 10}));
  EXPECT_EQ(read->vary->timers, (Ratio{1, 4}));
  const auto again = parse_scenario(effective_yaml(*read), "effective", {}, SpecPath{});
  ASSERT_TRUE(again) << to_string(again.error());
  EXPECT_EQ(*again, *read);
}

TEST(LimitsAndRanges, are_absent_unless_given) {
  const auto read = parse_scenario(good, "good.yaml", {}, SpecPath{});
  ASSERT_TRUE(read);
  EXPECT_FALSE(read->limits.has_value());
  EXPECT_FALSE(read->vary.has_value());
  const std::vector<std::string> overrides{"limits.backlog=3"};
  const auto limited = parse_scenario(good, "good.yaml", overrides, SpecPath{});
  ASSERT_TRUE(limited && limited->limits);
  EXPECT_EQ(limited->limits->backlog, 3U);
  EXPECT_FALSE(limited->limits->completion.has_value());
}

TEST(BadInput, nothing_to_discover_is_refused) {
  const std::vector<std::string> overrides{"deployment.endpoints_per_participant=0",
                                           "dds.descriptors.default_publications=0",
                                           "dds.descriptors.default_subscriptions=0"};
  const auto read = parse_scenario(good, "good.yaml", overrides, SpecPath{});
  ASSERT_FALSE(read);
  EXPECT_EQ(read.error().where, "good.yaml:1:13");
  EXPECT_NE(read.error().message.find("at least one endpoint"), std::string::npos);
}

TEST(BadInput, every_single_key_is_missed) {
  std::size_t removed = 0;
  for (std::size_t begin = 0; begin < good.size(); begin = good.find('\n', begin) + 1) {
    const std::string line = good.substr(begin, good.find('\n', begin) - begin);
    if (line.ends_with(":") || line.find("- {") != std::string::npos) continue;
    const auto read = parse_scenario(with(line + "\n", ""), "f", {}, SpecPath{});
    ASSERT_FALSE(read) << line;
    EXPECT_NE(read.error().message.find("missing key"), std::string::npos) << line;
    ++removed;
  }
  EXPECT_EQ(removed, 43U);
}

}  // namespace bad_input_test
}  // namespace stormproof::model::config
