// The list of numeric knobs says what `--set` would take and give; `is_valid` says what the reader
// would say.
#include "model/config/knobs/numeric_knobs.hpp"

#include <algorithm>

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "model/config/knobs/effective.hpp"
#include "model/config/scenario_file.hpp"
#include "tests/model/config/test_files.hpp"
#include "tests/props/monitored_run.hpp"

namespace stormproof::model::config {
namespace numeric_knobs_test {

using props::shipped;

const NumericKnob* find(const std::vector<NumericKnob>& knobs, const std::string& key) {
  const auto found = std::ranges::find(knobs, key, &NumericKnob::key);
  return found == knobs.end() ? nullptr : &*found;
}

bool reader_accepts(const Scenario& scenario) {
  return static_cast<bool>(parse_scenario(effective_json(scenario).dump(), "", {}, SpecPath{}));
}

TEST(NumericKnobs, have_values_units_and_ranges) {
  const std::vector<NumericKnob> knobs = numeric_knobs(shipped("wifi-5x20"));
  const NumericKnob* period = find(knobs, "dds.sedp.heartbeat_period");
  ASSERT_NE(period, nullptr);
  EXPECT_EQ(period->value, 1'000'000'000);
  EXPECT_EQ(period->unit, NumericKnob::Unit::nanoseconds);
  EXPECT_EQ(period->minimum, 1);
  const NumericKnob* last = find(knobs, "dds.descriptors.default_bytes.1");
  ASSERT_NE(last, nullptr);
  EXPECT_EQ(last->value, 532);
  const NumericKnob* rate = find(knobs, "wireless.rate_unicast");
  ASSERT_NE(rate, nullptr);
  EXPECT_EQ(print_quantity(rate->unit, rate->value), "144.4Mbps");
}

TEST(NumericKnobs, have_the_lease_of_a_life) {
  const Scenario scenario = shipped("smallest", {"dds.amendments={}", "deployment.life.lease=20s"});
  const std::vector<NumericKnob> knobs = numeric_knobs(scenario);
  const NumericKnob* lease = find(knobs, "deployment.life.lease");
  ASSERT_NE(lease, nullptr);
  EXPECT_EQ(lease->value, 20'000'000'000);
  Scenario other = scenario;
  EXPECT_TRUE(set_numeric_knob(other, lease->key, 1'000));
  EXPECT_EQ(other.deployment.life->lease, Nanoseconds{1'000});
  EXPECT_EQ(find(numeric_knobs(shipped("smallest")), "deployment.life.lease"), nullptr);
}

TEST(NumericKnobs, leave_out_what_nothing_depends_on) {
  const auto paper = numeric_knobs(shipped("wifi-5x20"));
  EXPECT_EQ(find(paper, "wireless.one_way"), nullptr);
  EXPECT_EQ(find(paper, "time_limit"), nullptr);
  EXPECT_EQ(find(paper, "dds.sedp.adaptive.epsilon"), nullptr);
  const auto fastdds = numeric_knobs(shipped("live-5x20"));
  EXPECT_EQ(find(fastdds, "dds.descriptors.user_bytes"), nullptr);
  EXPECT_EQ(find(fastdds, "dds.sedp.heartbeat_bytes"), nullptr);
  EXPECT_NE(find(fastdds, "dds.sedp.piggyback_threshold_bytes"), nullptr);
  const auto delay =
      numeric_knobs(shipped("wifi-5x20", {"wireless={kind: constant_delay, one_way: 1ms}"}));
  EXPECT_NE(find(delay, "wireless.one_way"), nullptr);
  EXPECT_EQ(find(delay, "wireless.rate_unicast"), nullptr);
}

TEST(NumericKnobs, one_of_a_profile_by_its_key) {
  const DdsProfile dds = shipped("wifi-5x20").dds;
  EXPECT_EQ(numeric_knob(dds, "sedp.piggyback_threshold_bytes"), 106'496);
  EXPECT_EQ(numeric_knob(dds, "spdp.startup_announcements"), 5);
  EXPECT_EQ(numeric_knob(dds, "sedp.no_such_key"), std::nullopt);
  EXPECT_EQ(numeric_knob(dds, "sedp.acknowledge"), std::nullopt);
  EXPECT_EQ(numeric_knob(dds, "sedp"), std::nullopt);
}

TEST(NumericKnobs, leave_out_words_and_absent_overrides) {
  const auto unlimited =
      numeric_knobs(shipped("wifi-5x20", {"wireless.source_queue_bytes=unlimited"}));
  EXPECT_EQ(find(unlimited, "wireless.source_queue_bytes"), nullptr);
  EXPECT_EQ(find(unlimited, "wireless.stages.0.overhead_unicast"), nullptr);
  const auto stage =
      numeric_knobs(shipped("wifi-5x20", {"wireless.stages.0.overhead_unicast=5us"}));
  const NumericKnob* overhead = find(stage, "wireless.stages.0.overhead_unicast");
  ASSERT_NE(overhead, nullptr);
  EXPECT_EQ(overhead->value, 5'000);
}

TEST(NumericKnobs, keys_and_values_are_those_of_overrides) {
  for (const char* name : {"wifi-5x20", "live-5x20", "three-hosts"}) {
    const Scenario scenario = shipped(name);
    for (const NumericKnob& knob : numeric_knobs(scenario)) {
      const std::string change = knob.key + "=" + print_quantity(knob.unit, knob.value);
      EXPECT_EQ(shipped(name, {change}), scenario) << change;
    }
  }
}

TEST(NumericKnobs, setting_one_does_what_an_override_does) {
  const std::string key = "dds.sedp.nack_response_delay";
  Scenario scenario = shipped("wifi-5x20");
  EXPECT_TRUE(set_numeric_knob(scenario, key, 123));
  EXPECT_EQ(scenario, shipped("wifi-5x20", {key + "=123ns"}));
  const Scenario before = scenario;
  EXPECT_FALSE(set_numeric_knob(scenario, key, -1));
  EXPECT_FALSE(set_numeric_knob(scenario, "dds.sedp.heartbeat_period", 0));
  EXPECT_FALSE(set_numeric_knob(scenario, "dds.sedp.no_such_knob", 1));
  EXPECT_FALSE(set_numeric_knob(scenario, "wireless.one_way", 1));
  EXPECT_EQ(scenario, before);
}

TEST(IsValid, agrees_with_the_reader_about_every_knob) {
  int accepted = 0;
  int refused = 0;
  for (const char* name : {"smallest", "staggered-joins"}) {
    const Scenario base = shipped(name);
    ASSERT_TRUE(is_valid(base));
    for (const NumericKnob& knob : numeric_knobs(base)) {
      for (const std::int64_t value :
           {knob.minimum, knob.maximum, std::int64_t{1}, knob.value * 3 + 1, knob.value / 40}) {
        Scenario changed = base;
        if (!set_numeric_knob(changed, knob.key, value)) continue;
        const bool expected = reader_accepts(changed);
        ++(expected ? accepted : refused);
        EXPECT_EQ(is_valid(changed), expected) << knob.key << " = " << value;
      }
    }
  }
  EXPECT_GT(accepted, 100);
  EXPECT_GT(refused, 5);
}

template <class Change>
void expect_invalid(const char* what, Change&& change, const char* name = "smallest") {
  Scenario scenario = shipped(name);
  change(scenario);
  EXPECT_FALSE(is_valid(scenario)) << what;
}

TEST(IsValid, refuses_values_out_of_range) {
  expect_invalid("mtu", [](Scenario& s) { s.wireless.mtu_payload_bytes = Bytes{0}; });
  expect_invalid("period", [](Scenario& s) { s.dds.spdp.period = Nanoseconds{0}; });
  expect_invalid("negative", [](Scenario& s) { s.wireless.overhead_unicast = Nanoseconds{-1}; });
  expect_invalid("time limit", [](Scenario& s) { s.time_limit = Nanoseconds{0}; });
  expect_invalid("word", [](Scenario& s) { s.wireless.order = static_cast<ServiceOrder>(9); });
  expect_invalid("text", [](Scenario& s) { s.wireless.stages[0].name.clear(); });
  expect_invalid("epsilon", [](Scenario& s) { s.dds.sedp.adaptive.epsilon_numerator = 0; });
  expect_invalid("loss", [](Scenario& s) { s.vary.emplace().loss = Ratio{3, 2}; });
  expect_invalid("unreduced", [](Scenario& s) { s.vary.emplace().loss = Ratio{2, 4}; });
  expect_invalid("route", [](Scenario& s) { s.wireless.stages.clear(); });
}

TEST(IsValid, refuses_what_does_not_fit_together) {
  expect_invalid("one host", [](Scenario& s) { s.deployment.participants[1].host = HostId{0}; });
  expect_invalid("done before start",
                 [](Scenario& s) { s.deployment.participants[0].start = Nanoseconds{5}; });
  expect_invalid("crossed periods",
                 [](Scenario& s) { s.dds.sedp.adaptive.min_period = Nanoseconds{4'000'000'000}; });
  expect_invalid("order of losses", [](Scenario& s) { s.wireless.lost_packets = {5, 3}; });
  expect_invalid("twice lost", [](Scenario& s) { s.wireless.lost_packets = {3, 3}; });
  expect_invalid("delays of a channel", [](Scenario& s) {
    s.wireless.packet_delays = {{0, Nanoseconds{0}, Nanoseconds{1}}};
  });
  expect_invalid(
      "not the drawn time",
      [](Scenario& s) { s.deployment.participants[0].endpoints_done += Nanoseconds{1}; },
      "live-5x20");
  expect_invalid("limit beyond the end", [](Scenario& s) {
    s.limits.emplace().completion = s.time_limit + Nanoseconds{1};
  });
}

}  // namespace numeric_knobs_test
}  // namespace stormproof::model::config
