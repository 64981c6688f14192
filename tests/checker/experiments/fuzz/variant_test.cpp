// Variants stay within their ranges, are valid, and depend on seed and number alone.
#include "checker/experiments/fuzz/variant.hpp"

#include <algorithm>
#include <set>

#include <gtest/gtest.h>

#include "tests/props/monitored_run.hpp"

namespace stormproof::fuzz {
namespace variant_test {

using model::config::is_valid;
using model::config::NumericKnob;
using props::shipped;

std::int64_t value_of(const model::Scenario& scenario, const std::string& key) {
  for (const NumericKnob& knob : model::config::numeric_knobs(scenario)) {
    if (knob.key == key) return knob.value;
  }
  ADD_FAILURE() << "no knob " << key;
  return 0;
}

TEST(Ranges, the_usual_ones_stand_in_for_none) {
  const Ranges none = ranges_around(shipped("smallest"), {});
  EXPECT_TRUE(none.usual);
  EXPECT_EQ(none.vary, usual_variation());
  const Ranges loss = ranges_around(shipped("smallest", {"vary.loss=0.5"}), {});
  EXPECT_FALSE(loss.usual);
  EXPECT_FALSE(loss.vary.start_jitter.has_value());
  const Ranges nothing = ranges_around(shipped("smallest", {"vary={}"}), {});
  EXPECT_FALSE(nothing.usual);
  EXPECT_EQ(nothing.vary, model::Variation{});
  const Ranges schedule = ranges_around(shipped("live-5x20"), {});
  EXPECT_TRUE(schedule.schedule);
  EXPECT_FALSE(schedule.usual);
}

TEST(Ranges, of_knobs_are_read_or_refused) {
  const model::Scenario scenario = shipped("smallest");
  const auto range = parse_knob_range("dds.sedp.heartbeat_period=10ms..2s", scenario);
  ASSERT_TRUE(range);
  EXPECT_EQ(range->low, 10'000'000);
  EXPECT_EQ(range->high, 2'000'000'000);
  const auto refused = [&](const std::string& text, const char* why) {
    const auto read = parse_knob_range(text, scenario);
    ASSERT_FALSE(read) << text;
    EXPECT_EQ(read.error().where, "--vary " + text);
    EXPECT_NE(read.error().message.find(why), std::string::npos) << read.error().message;
  };
  refused("dds.sedp.heartbeat_period", "expected KEY=LOW..HIGH");
  refused("dds.sedp.heartbeat_period=1s", "expected KEY=LOW..HIGH");
  refused("dds.sedp.heartbeat_period=1..2", "no unit");
  refused("dds.sedp.heartbeat_period=2s..1s", "is more than");
  refused("dds.sedp.heartbeat_period=0s..1s", "out of range; expected 1ns to 1000000s");
  refused("dds.sedp.heartbeat_perod=1s..2s", "did you mean 'dds.sedp.heartbeat_period'");
  refused("time_limit=1s..2s", "no numeric knob");
  refused("dds.sedp.acknack_bytes=1.5..2", "expected KEY=LOW..HIGH");
}

TEST(Ranges, relative_ones_cover_their_knobs_only) {
  const model::Scenario scenario = shipped("wifi-5x20", {"dds.sedp.initial_acknack_delay=0"});
  const auto has = [](const std::vector<NumericKnob>& knobs, const char* key) {
    return std::ranges::find(knobs, key, &NumericKnob::key) != knobs.end();
  };
  EXPECT_TRUE(has(size_knobs(scenario), "dds.descriptors.user_bytes"));
  EXPECT_FALSE(has(size_knobs(scenario), "dds.sedp.grouping_limit_bytes"));
  EXPECT_FALSE(has(size_knobs(scenario), "wireless.mtu_payload_bytes"));
  EXPECT_TRUE(has(delay_knobs(scenario), "wireless.rate_unicast"));
  EXPECT_TRUE(has(delay_knobs(scenario), "wireless.overhead_multicast"));
  EXPECT_FALSE(has(delay_knobs(scenario), "dds.sedp.heartbeat_period"));
  EXPECT_TRUE(has(timer_knobs(scenario), "dds.sedp.heartbeat_period"));
  EXPECT_FALSE(has(timer_knobs(scenario), "dds.sedp.initial_acknack_delay"));  // it is off
  EXPECT_TRUE(size_knobs(shipped("live-5x20")).empty());
}

TEST(Variants, stay_within_their_ranges) {
  const model::Scenario base =
      shipped("wifi-5x20", {"vary={start_jitter: 3ms, sizes: 0.1, delays: 0.2, timers: 0.5}"});
  const Ranges ranges =
      ranges_around(base, {*parse_knob_range("dds.sedp.acknack_bytes=70..72", base)});
  const VariantSource variants{base, ranges};
  std::set<std::int64_t> acknacks;
  for (std::uint64_t k = 0; k < 50; ++k) {
    const auto variant = variants.draw(7, k);
    ASSERT_TRUE(variant);
    const model::Scenario& s = variant->scenario;
    EXPECT_TRUE(is_valid(s));
    EXPECT_FALSE(s.vary.has_value());
    for (const auto& participant : s.deployment.participants) {
      EXPECT_GE(participant.start.count(), 0);
      EXPECT_LE(participant.start.count(), 3'000'000);
      EXPECT_EQ(participant.endpoints_done, participant.start);
    }
    EXPECT_NEAR(static_cast<double>(value_of(s, "dds.descriptors.user_bytes")), 460, 46);
    EXPECT_NEAR(static_cast<double>(value_of(s, "wireless.rate_unicast")), 144.4e6, 28.88e6);
    EXPECT_NEAR(static_cast<double>(value_of(s, "dds.sedp.heartbeat_period")), 1e9, 5e8);
    EXPECT_EQ(value_of(s, "dds.sedp.piggyback_threshold_bytes"), 106'496);
    EXPECT_EQ(s.time_limit, base.time_limit);
    acknacks.insert(value_of(s, "dds.sedp.acknack_bytes"));
  }
  EXPECT_EQ(acknacks, (std::set<std::int64_t>{70, 71, 72}));
}

TEST(Variants, depend_on_seed_and_number) {
  const model::Scenario base = shipped("smallest", {"vary={start_jitter: 1s, timers: 0.5}"});
  const Ranges ranges = ranges_around(base, {});
  const VariantSource variants{base, ranges};
  const VariantSource again{base, ranges};
  EXPECT_EQ(variants.draw(1, 2)->scenario, again.draw(1, 2)->scenario);
  EXPECT_NE(variants.draw(1, 2)->scenario, variants.draw(1, 3)->scenario);
  EXPECT_NE(variants.draw(1, 2)->scenario, variants.draw(2, 2)->scenario);
}

TEST(Variants, draw_the_schedule_anew) {
  const model::Scenario base = shipped("live-5x20");
  const Ranges ranges = ranges_around(base, {});
  const VariantSource variants{base, ranges};
  std::set<std::int64_t> starts;
  for (std::uint64_t k = 0; k < 20; ++k) {
    const model::Scenario s = variants.draw(0, k)->scenario;
    EXPECT_FALSE(s.deployment.schedule.has_value());
    const auto& first = s.deployment.participants.front();
    EXPECT_GE(first.start, base.deployment.schedule->start_min);
    EXPECT_LE(first.start, base.deployment.schedule->start_max);
    starts.insert(first.start.count());
  }
  EXPECT_EQ(starts.size(), 20U);
}

/// The step is that of a launch plan, of processes and of hosts.
TEST(Variants, starts_are_spread_within_their_range) {
  const model::Scenario base = shipped("live-5x20");
  const auto range = parse_knob_range("deployment.launch=100ms..400ms", base);
  ASSERT_TRUE(range);
  const Ranges ranges = ranges_around(base, {*range});
  EXPECT_EQ(describe(ranges, base).back().text,
            "processes or hosts one by one, 100ms to 400ms apart");
  const VariantSource variants{base, ranges};
  std::size_t hosts = 0;
  for (std::uint64_t k = 0; k < 20; ++k) {
    const auto variant = variants.draw(3, k);
    ASSERT_TRUE(variant);
    const auto& all = variant->scenario.deployment.participants;
    const std::int64_t between_two = (all[1].start - all[0].start).count();
    const bool by_host = between_two < 60'000'000;  // what the schedule spreads
    if (by_host) ++hosts;
    const std::int64_t whole = (all.back().start - all.front().start).count();
    const std::int64_t steps = by_host ? 1 : static_cast<std::int64_t>(all.size()) - 1;
    EXPECT_GE(whole, 100'000'000 * steps - 60'000'000);
    EXPECT_LE(whole, 400'000'000 * steps + 60'000'000);
  }
  EXPECT_GT(hosts, 2U);
  EXPECT_LT(hosts, 18U);
}

TEST(Variants, invalid_draws_are_counted_and_repeated) {
  const model::Scenario base = shipped("smallest");
  const Ranges often =
      ranges_around(base, {*parse_knob_range("dds.sedp.adaptive.min_period=1s..5s", base),
                           *parse_knob_range("dds.sedp.adaptive.max_period=1s..5s", base)});
  const VariantSource variants{base, often};
  std::uint32_t rejected = 0;
  for (std::uint64_t k = 0; k < 40; ++k) {
    const auto variant = variants.draw(0, k);
    ASSERT_TRUE(variant);
    EXPECT_TRUE(is_valid(variant->scenario));
    rejected += variant->rejected;
  }
  EXPECT_GT(rejected, 10U);
  const Ranges never =
      ranges_around(base, {*parse_knob_range("dds.sedp.shared_header_bytes=2000..3000", base)});
  EXPECT_FALSE((VariantSource{base, never}.draw(0, 0)));
}

TEST(Losses, have_the_stated_rate_and_continue_each_other) {
  const model::Scenario base = shipped("smallest", {"vary.loss=1/50"});
  const Ranges ranges = ranges_around(base, {});
  const VariantSource variants{base, ranges};
  const auto many = variants.losses(3, 4, 100'000);
  EXPECT_NEAR(static_cast<double>(many.size()), 2'000, 5 * 44);  // 5 standard deviations
  EXPECT_TRUE(std::ranges::is_sorted(many));
  EXPECT_LT(many.back(), 100'000U);
  const auto few = variants.losses(3, 4, 1'000);
  EXPECT_TRUE(std::equal(few.begin(), few.end(), many.begin()));
  EXPECT_GE(many[few.size()], 1'000U);
  EXPECT_NE(variants.losses(3, 5, 1'000), few);
  const Ranges all = ranges_around(shipped("smallest", {"vary.loss=1"}), {});
  EXPECT_EQ((VariantSource{base, all}.losses(0, 0, 10).size()), 10U);
}

TEST(Variants, have_the_failures_that_are_asked_for) {
  const model::Scenario base =
      shipped("smallest", {"dds.amendments={}", "time_limit=60s",
                           "vary={outages: 2, restarts: 1, late_joiners: 1, new_endpoints: 1, "
                           "failures_within: 5s}"});
  const Ranges ranges = ranges_around(base, {});
  const VariantSource source{base, ranges};
  const model::Nanoseconds latest{5'000'000'000};
  std::size_t outages = 0;
  std::size_t restarts = 0;
  std::size_t late = 0;
  std::size_t changes = 0;
  for (std::uint64_t number = 0; number < 200; ++number) {
    const auto variant = source.draw(3, number);
    ASSERT_TRUE(variant) << number;
    const model::Deployment& deployment = variant->scenario.deployment;
    for (std::size_t i = 0; i < deployment.size(); ++i) {
      const auto later = deployment.participants[i].start - base.deployment.participants[i].start;
      EXPECT_LE(later, latest);
      late += later.count() > 0 ? 1U : 0U;
    }
    if (!deployment.life) continue;
    EXPECT_LE(deployment.life->outages.size(), 2U);
    EXPECT_LE(deployment.life->restarts.size(), 1U);
    for (const model::Outage& outage : deployment.life->outages) EXPECT_LE(outage.end, latest);
    for (const model::Restart& restart : deployment.life->restarts) {
      EXPECT_LE(restart.start, latest + latest + model::Nanoseconds{1});
    }
    for (const model::LateEndpoints& endpoints : deployment.life->endpoints) {
      EXPECT_LE(endpoints.until.value_or(endpoints.at), latest + latest);
    }
    changes += deployment.life->endpoints.size();
    outages += deployment.life->outages.size();
    restarts += deployment.life->restarts.size();
  }
  EXPECT_GT(outages, 50U);
  EXPECT_GT(restarts, 50U);
  EXPECT_GT(late, 50U);
  EXPECT_GT(changes, 50U);
}

/// Those who ask for none get the values that they had without such ranges.
TEST(Variants, of_failures_draw_in_a_stream_of_their_own) {
  const std::vector<std::string> plain{"dds.amendments={}", "vary={timers: 0.5}"};
  std::vector<std::string> failing = plain;
  failing.back() = "vary={timers: 0.5, outages: 2}";
  const model::Scenario one = shipped("smallest", plain);
  const model::Scenario other = shipped("smallest", failing);
  const Ranges of_one = ranges_around(one, {});
  const Ranges of_other = ranges_around(other, {});
  for (std::uint64_t number = 0; number < 20; ++number) {
    const auto without = VariantSource{one, of_one}.draw(1, number);
    const auto with = VariantSource{other, of_other}.draw(1, number);
    ASSERT_TRUE(without && with);
    EXPECT_EQ(without->scenario.dds, with->scenario.dds);
  }
}

}  // namespace variant_test
}  // namespace stormproof::fuzz
