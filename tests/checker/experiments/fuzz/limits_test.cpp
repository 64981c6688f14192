// The monitors of limits count what reports count, object to the first event beyond a limit and to
// nothing at it.
#include "props/limits.hpp"

#include <algorithm>
#include <type_traits>

#include <gtest/gtest.h>

#include "model/reference.hpp"
#include "model/simulator.hpp"
#include "model/trace/probe_list.hpp"
#include "model/trace/replay.hpp"
#include "props/generators/space.hpp"
#include "props/verdict.hpp"
#include "tests/props/monitored_run.hpp"

namespace stormproof::props {
namespace limits_test {

struct Outcome {
  model::RunResult result;
  std::vector<LimitReading> readings;

  [[nodiscard]] const LimitReading& of(std::string_view id) const {
    return *std::ranges::find(readings, id, &LimitReading::id);
  }
};

Outcome run(const model::Scenario& scenario) {
  LimitWatch watch{scenario};
  model::trace::ProbeList probes;
  for (model::Probe* probe : watch.probes()) probes.add(*probe);
  model::RunOptions options;
  options.probe = &probes;
  Outcome outcome{model::simulate(scenario, options), {}};
  outcome.readings = watch.finish(model::trace::known_until(outcome.result, scenario));
  return outcome;
}

/// With limits that nothing exceeds.
model::Scenario watched(model::Scenario scenario) {
  scenario.limits =
      model::Limits{scenario.time_limit, 1'000'000'000, model::Ratio{1'000'000, 1}, 1'000'000'000};
  return scenario;
}

std::uint64_t highest_backlog(const model::RunResult& result) {
  std::uint64_t highest = 0;
  for (const auto& peak : result.backlog) highest = std::max(highest, peak.packets);
  return highest;
}

void expect_counts_as_the_report_does(const model::Scenario& scenario, std::uint64_t seed) {
  const Outcome outcome = run(watched(scenario));
  const auto messages = static_cast<double>(outcome.result.counts.total());
  EXPECT_EQ(outcome.of("limit.messages").reached, messages) << seed;
  const auto reference = static_cast<double>(model::failure_free_reference(scenario).total());
  EXPECT_EQ(outcome.of("limit.amplification").reached, messages / reference) << seed;
  const auto backlog = static_cast<double>(highest_backlog(outcome.result));
  if (!outcome.result.channels.empty()) {
    EXPECT_EQ(outcome.of("limit.backlog").reached, backlog) << seed;
  }
  const auto& discovered = outcome.result.discovery_time;
  const auto& reached = outcome.of("limit.completion").reached;
  EXPECT_EQ(reached.has_value(), discovered.has_value()) << seed;
  if (discovered && reached) {
    EXPECT_EQ(*reached, static_cast<double>(discovered->count())) << seed;
  }
}

TEST(Limits, count_as_the_report_does) {
  ScenarioSpace space;
  space.run_until = model::RunUntil::completion;
  for (const auto kind : {model::ImplementationKind::paper, model::ImplementationKind::fastdds}) {
    space.implementation = kind;
    for (std::uint64_t seed = 0; seed < 60; ++seed) {
      expect_counts_as_the_report_does(draw_scenario(seed, static_cast<int>(seed), space), seed);
    }
  }
}

TEST(Limits, count_as_the_report_does_in_shipped_scenarios) {
  for (const char* name : {"smallest", "three-hosts", "staggered-joins", "wifi-5x20-fastdds"}) {
    expect_counts_as_the_report_does(shipped(name), 0);
  }
}

TEST(Limits, what_follows_completion_does_not_count) {
  model::Scenario scenario = watched(shipped("smallest"));
  const Outcome until_completion = run(scenario);
  scenario.run_until = model::RunUntil::time_limit;
  scenario.time_limit = model::Nanoseconds{20'000'000'000};
  const Outcome beyond = run(watched(scenario));
  EXPECT_GT(beyond.result.counts.total(), until_completion.result.counts.total());
  for (const char* id : {"limit.completion", "limit.backlog"}) {
    EXPECT_EQ(beyond.of(id).reached, until_completion.of(id).reached) << id;
  }
  EXPECT_LT(*beyond.of("limit.messages").reached,
            static_cast<double>(beyond.result.counts.total()));
}

using model::Limits;

/// One limit and no other.
template <class T>
Limits only(std::optional<T> Limits::*limit, const std::type_identity_t<T>& value) {
  Limits limits;
  limits.*limit = value;
  return limits;
}

/// Whether the run exceeds the only limit of the scenario.
bool exceeds(model::Scenario scenario, const model::Limits& limits) {
  scenario.limits = limits;
  return run(scenario).readings.at(0).exceeded;
}

TEST(Limits, are_inclusive) {
  const model::Scenario scenario = shipped("three-hosts", {"wireless.source_queue_bytes=2000"});
  const model::RunResult result = model::simulate(scenario);
  const model::Nanoseconds time = *result.discovery_time;
  EXPECT_FALSE(exceeds(scenario, only(&Limits::completion, time)));
  EXPECT_TRUE(exceeds(scenario, only(&Limits::completion, time - model::Nanoseconds{1})));
  EXPECT_FALSE(exceeds(scenario, only(&Limits::messages, result.counts.total())));
  EXPECT_TRUE(exceeds(scenario, only(&Limits::messages, result.counts.total() - 1)));
  const std::uint64_t backlog = highest_backlog(result);
  ASSERT_GT(backlog, 0U);
  EXPECT_FALSE(exceeds(scenario, only(&Limits::backlog, backlog)));
  EXPECT_TRUE(exceeds(scenario, only(&Limits::backlog, backlog - 1)));
  const auto total = static_cast<std::int64_t>(result.counts.total());
  const auto reference = static_cast<std::int64_t>(model::failure_free_reference(scenario).total());
  EXPECT_FALSE(exceeds(scenario, only(&Limits::amplification, model::Ratio{total, reference})));
  EXPECT_TRUE(exceeds(scenario, only(&Limits::amplification, model::Ratio{total - 1, reference})));
}

TEST(Limits, a_run_that_never_completes_exceeds_its_completion) {
  model::Scenario scenario = shipped("smallest");
  for (std::uint64_t packet = 0; packet < 10'000; ++packet) {
    scenario.wireless.lost_packets.push_back(packet);
  }
  scenario.time_limit = model::Nanoseconds{10'000'000'000};
  EXPECT_TRUE(exceeds(scenario, only(&Limits::completion, scenario.time_limit)));
  scenario.limits = only(&Limits::completion, scenario.time_limit);
  EXPECT_FALSE(run(scenario).readings.at(0).reached.has_value());
}

TEST(Limits, have_monitors_and_statements_only_if_they_are_set) {
  model::Scenario scenario = shipped("smallest");
  EXPECT_EQ(make_monitor("limit.messages", scenario), nullptr);
  scenario.limits = only(&Limits::messages, 5);
  EXPECT_NE(make_monitor("limit.messages", scenario), nullptr);
  EXPECT_EQ(make_monitor("limit.backlog", scenario), nullptr);
  EXPECT_EQ(set_limits(scenario.limits), std::vector<std::string_view>{"limit.messages"});
  for (const Property& property : limit_properties()) {
    EXPECT_EQ(find_property(property.id), &property);
    const bool in_catalogue = std::ranges::any_of(
        catalogue(), [&](const Property& other) { return other.id == property.id; });
    EXPECT_FALSE(in_catalogue) << property.id;
  }
}

TEST(Limits, the_first_event_beyond_them_is_named) {
  model::Scenario scenario = shipped("three-hosts");
  scenario.limits = only(&Limits::messages, 100);
  const auto monitor = make_monitor("limit.messages", scenario);
  model::RunOptions options;
  options.probe = monitor.get();
  (void)model::simulate(scenario, options);
  ASSERT_TRUE(monitor->violation());
  EXPECT_NE(monitor->violation()->reason.find("the limit is 100"), std::string::npos);
  options.probe = nullptr;
  options.max_events = monitor->violation()->event + 1;
  EXPECT_GT(model::simulate(scenario, options).counts.total(), 100U);
  options.max_events = monitor->violation()->event;
  EXPECT_LE(model::simulate(scenario, options).counts.total(), 100U);
}

}  // namespace limits_test
}  // namespace stormproof::props
