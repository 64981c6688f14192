// Effects have the same names everywhere: what a run does is what the recorded composition lists,
// and everything that it lists happens in some run. A mistake at an effect is made in the run.
#include <map>
#include <set>
#include <string>

#include <gtest/gtest.h>

#include "fsm/composition/compositions.hpp"
#include "model/composition_of.hpp"
#include "model/implementations.hpp"
#include "model/probe.hpp"
#include "model/simulator.hpp"
#include "props/generators/dice.hpp"
#include "props/generators/on_demand.hpp"
#include "tests/oracle/random_scenario.hpp"

namespace stormproof::model {
namespace effects_test {

using fsm::composition::CompositionInfo;
using fsm::composition::EffectKey;
using fsm::composition::RuleInfo;

TEST(CompositionOf, HasTheNameOfTheImplementation) {
  EXPECT_EQ(composition_of(ImplementationKind::paper).name, "paper");
  EXPECT_EQ(composition_of(ImplementationKind::fastdds).name, "fastdds");
  EXPECT_EQ(composition_of(ImplementationKind::cyclone).name, "cyclone");
}

class Effects : public Probe {
 public:
  [[nodiscard]] bool wants_effects() const override { return true; }
  void effect(EffectKey key) override { seen.insert(key); }

  std::set<EffectKey> seen;
};

/// With what the rules have for profiles and deployments that random scenarios have not.
Scenario scenario_of(std::uint64_t seed, ImplementationKind kind) {
  Scenario scenario = oracle::random_scenario(seed, kind);
  if (seed % 4 == 0) scenario.dds.version.match_order = MatchOrder::builtin_first;
  const ImplementationTraits& traits = traits_of(kind);
  const bool has_types =
      traits.has_control_relations && !traits.has_server && !traits.has_own_timers && seed % 4 == 1;
  props::Dice dice{seed};
  if (has_types) props::draw_types(dice, scenario);
  return scenario;
}

class EveryEffect : public testing::TestWithParam<ImplementationKind> {};

TEST_P(EveryEffect, HappensInSomeRunAndHasItsNameThere) {
  const CompositionInfo& composition = composition_of(GetParam());
  const std::map<EffectKey, std::string> known = fsm::composition::effect_ids(composition);
  std::size_t effects_listed = 0;
  for (const auto* list : {&composition.rules, &composition.procedures}) {
    for (const RuleInfo& rule : *list) effects_listed += rule.effects.size();
  }
  EXPECT_EQ(known.size(), effects_listed) << "two effects have one key";
  Effects effects;
  for (std::uint64_t seed = 1; seed <= 300; ++seed) {
    const Scenario scenario = scenario_of(seed, GetParam());
    RunOptions options;
    options.probe = &effects;
    options.max_events = 20'000;
    (void)simulate(scenario, options);
  }
  for (const EffectKey key : effects.seen) {
    EXPECT_TRUE(known.contains(key)) << "an effect that is not on the page";
  }
  std::set<std::string> never;
  for (const auto& [key, id] : known) {
    if (!effects.seen.contains(key)) never.insert(id);
  }
  EXPECT_EQ(never, std::set<std::string>{});
}

INSTANTIATE_TEST_SUITE_P(Implementations, EveryEffect, testing::ValuesIn(implementations));

/// Watching changes nothing.
TEST(Effects, AreToldWithoutChangingTheRun) {
  for (const ImplementationKind kind : implementations) {
    const Scenario scenario = oracle::random_scenario(7, kind);
    Effects effects;
    RunOptions options;
    options.probe = &effects;
    const RunResult watched = simulate(scenario, options);
    const RunResult alone = simulate(scenario, {});
    EXPECT_EQ(watched.events, alone.events);
    EXPECT_EQ(watched.end_time, alone.end_time);
    EXPECT_FALSE(effects.seen.empty());
  }
}

/// Most mistakes at effects change some run; the others are those of which nothing can be seen.
TEST_P(EveryEffect, CanBeWrong) {
  const auto mutations = fsm::composition::effect_mutations(composition_of(GetParam()));
  std::vector<Scenario> scenarios;
  std::vector<RunResult> correct;
  RunOptions options;
  options.max_events = 5'000;
  for (std::uint64_t seed = 1; seed <= 60; ++seed) {
    scenarios.push_back(scenario_of(seed, GetParam()));
    correct.push_back(simulate(scenarios.back(), options));
  }
  std::size_t differ = 0;
  for (const auto& effect : mutations) {
    Mutation mutation;
    mutation.effects.push_back(effect);
    options.mutation = &mutation;
    bool found = false;
    for (std::size_t k = 0; k < scenarios.size() && !found; ++k) {
      const RunResult wrong = simulate(scenarios[k], options);
      found = wrong.events != correct[k].events || wrong.end_time != correct[k].end_time ||
              wrong.counts != correct[k].counts;
    }
    if (found) ++differ;
  }
  EXPECT_GE(100 * differ, 80 * mutations.size()) << differ << " of " << mutations.size();
}

}  // namespace effects_test
}  // namespace stormproof::model
