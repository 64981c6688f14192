// The list of unread knobs against the machines: changing what is said to be unread must not change
// a byte of a trace, and each rule, applied where its condition does not hold, must be found out.
#include "checker/experiments/diff/normal_form.hpp"

#include <algorithm>
#include <ostream>
#include <set>
#include <string>

#include <gtest/gtest.h>

#include "checker/experiments/diff/diff.hpp"
#include "model/config/knobs/numeric_knobs.hpp"
#include "model/simulator.hpp"
#include "model/trace/trace_writer.hpp"
#include "props/generators/on_demand.hpp"
#include "props/generators/space.hpp"

namespace stormproof::diff {

void PrintTo(const UnreadRule& rule, std::ostream* out) { *out << rule.key << ": " << rule.why; }

namespace normal_form_test {

using model::DdsProfile;
using model::ImplementationKind;
using model::Scenario;

/// Every event, packet and count of the run, but not the scenario that the header repeats.
struct Trace {
  std::size_t lines = 0;
  std::size_t hash = 0;

  bool operator==(const Trace&) const = default;
};

Trace trace_of(const Scenario& scenario) {
  Trace trace;
  bool header = true;
  model::trace::TraceWriter writer{[&](std::string_view line) {
                                     if (!header)
                                       trace.hash =
                                           trace.hash * 31 + std::hash<std::string_view>{}(line);
                                     header = false;
                                     ++trace.lines;
                                   },
                                   scenario};
  model::RunOptions options;
  options.probe = &writer;
  options.max_events = 3'000;
  writer.finish(model::simulate(scenario, options));
  return trace;
}

Scenario drawn(std::uint64_t seed) {
  props::ScenarioSpace space;
  space.max_participants = 4;
  space.max_time_limit = model::Nanoseconds{5'000'000'000};
  return props::draw_scenario(seed, static_cast<int>(seed % 100), space);
}

/// Any values of all knobs.
DdsProfile other_values(std::uint64_t seed) {
  props::ScenarioSpace space;
  space.implementation = ImplementationKind::paper;
  DdsProfile dds = props::draw_scenario(seed + 1'000'000, 50, space).dds;
  dds.version.typelookup_filter = model::LookupFilter::answers;
  dds.version.typelookup_unit = model::LookupUnit::participant;
  return dds;
}

Scenario with(const Scenario& scenario, const DdsProfile& dds) {
  Scenario changed = scenario;
  changed.dds = dds;
  return changed;
}

TEST(NormalForm, UnreadKnobsChangeNothingInATrace) {
  std::set<const UnreadRule*> exercised;
  for (std::uint64_t seed = 0; seed < 250; ++seed) {
    const Scenario scenario = drawn(seed);
    const DdsProfile others = other_values(seed);
    DdsProfile changed = scenario.dds;
    for (const UnreadRule& rule : unread_rules()) {
      if (!rule.applies(scenario.dds)) continue;
      const DdsProfile before = changed;
      rule.set(changed, others);
      if (changed != before) exercised.insert(&rule);
    }
    const Trace trace = trace_of(scenario);
    ASSERT_EQ(trace, trace_of(with(scenario, changed))) << "seed " << seed;
    ASSERT_EQ(trace, trace_of(with(scenario, normal_form(scenario.dds)))) << "seed " << seed;
  }
  // Draws rarely meet the conditions about exact values; those have a test below.
  for (const UnreadRule& rule : unread_rules()) {
    const bool exact = rule.key == "sedp.grouping" || rule.key == "sedp.piggyback";
    EXPECT_TRUE(exact || exercised.contains(&rule)) << rule.key << ": " << rule.why;
  }
}

TEST(NormalForm, ValuesThatMeanTheSameGiveTheSameTrace) {
  for (std::uint64_t seed = 0; seed < 100; ++seed) {
    Scenario scenario = drawn(seed);
    scenario.dds.sedp.piggyback = model::Piggyback::linear;
    scenario.dds.sedp.piggyback_threshold_bytes = model::Bytes{0};
    if (scenario.dds.implementation == ImplementationKind::paper) {
      scenario.dds.sedp.grouping = model::Grouping::message;
      scenario.dds.sedp.grouping_limit_bytes = model::Bytes{1'472};
    }
    const DdsProfile normal = normal_form(scenario.dds);
    EXPECT_EQ(normal.sedp.piggyback, model::Piggyback::cumulative);
    ASSERT_EQ(trace_of(scenario), trace_of(with(scenario, normal))) << "seed " << seed;
  }
}

TEST(NormalForm, OfItselfIsItself) {
  for (std::uint64_t seed = 0; seed < 200; ++seed) {
    const DdsProfile normal = normal_form(drawn(seed).dds);
    EXPECT_EQ(normal_form(normal), normal) << "seed " << seed;
  }
}

TEST(NormalForm, KeepsFractionsInLowestTermsAndForgetsUnmodelledSettings) {
  DdsProfile dds;
  dds.sedp.heartbeat_policy = model::HeartbeatPolicy::adaptive;
  DdsProfile doubled = dds;
  doubled.sedp.adaptive.epsilon_numerator *= 2;
  doubled.sedp.adaptive.epsilon_denominator *= 2;
  doubled.unmodelled["multicast"] = "off";
  EXPECT_EQ(normal_form(doubled), normal_form(dds));
  doubled.sedp.adaptive.epsilon_denominator += 1;
  EXPECT_NE(normal_form(doubled), normal_form(dds));
}

TEST(NormalForm, ImplementationsAreNeverTheSame) {
  DdsProfile paper;
  DdsProfile fastdds;
  fastdds.implementation = ImplementationKind::fastdds;
  EXPECT_NE(normal_form(paper), normal_form(fastdds));
}

/// With what later versions of Fast DDS have, every other time.
Scenario drawn_with_types(std::uint64_t seed) {
  Scenario scenario = drawn(seed);
  if (seed % 2 == 1 || scenario.dds.implementation != ImplementationKind::fastdds) return scenario;
  props::Dice dice{seed};
  props::draw_types(dice, scenario);
  return scenario;
}

/// A rule that is applied although its condition does not hold.
class MutatedRule : public testing::TestWithParam<UnreadRule> {};

TEST_P(MutatedRule, IsFoundOut) {
  const UnreadRule& rule = GetParam();
  std::uint64_t tried = 0;
  for (std::uint64_t seed = 0; seed < 1'000; ++seed) {
    const Scenario scenario = drawn_with_types(seed);
    if (rule.applies(scenario.dds)) continue;
    DdsProfile changed = scenario.dds;
    rule.set(changed, other_values(seed));
    if (changed == scenario.dds || !model::config::is_valid(with(scenario, changed))) continue;
    ++tried;
    if (trace_of(scenario) != trace_of(with(scenario, changed))) return;
  }
  ADD_FAILURE() << rule.key << ": no run of " << tried << " differs, so the condition that "
                << rule.why << " is not needed";
}

std::string name_of_rule(const testing::TestParamInfo<UnreadRule>& info) {
  std::string name{info.param.key};
  std::ranges::replace(name, '.', '_');
  return name + "_" + std::to_string(info.index);
}

INSTANTIATE_TEST_SUITE_P(Rules, MutatedRule,
                         testing::ValuesIn(unread_rules().begin(), unread_rules().end()),
                         name_of_rule);

}  // namespace normal_form_test
}  // namespace stormproof::diff
