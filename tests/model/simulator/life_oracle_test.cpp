// Participants that are forgotten and come back, in random scenarios: the product does what its
// oracle does, which keeps epochs where the product compares insertion numbers. Mistakes of the
// oracle say that the comparison can fail.
#include <algorithm>
#include <array>
#include <iostream>
#include <set>
#include <string>

#include <gtest/gtest.h>

#include "fsm/composition/compositions.hpp"
#include "model/composition_of.hpp"
#include "model/config/knobs/numeric_knobs.hpp"
#include "model/probe.hpp"
#include "model/simulator.hpp"
#include "props/generators/on_demand.hpp"
#include "tests/oracle/comparison.hpp"
#include "tests/oracle/random_scenario.hpp"

namespace stormproof::oracle {
namespace life_oracle_test {

/// A scenario of the paper with a life, and those amended rules that the oracle has.
model::Scenario living(std::uint64_t seed) {
  model::Scenario scenario = random_scenario(seed);
  props::Dice dice{seed};
  props::draw_amendments(dice, scenario);
  const model::Amendments drawn = *scenario.dds.amendments;
  scenario.dds.amendments = model::Amendments{};
  scenario.dds.amendments->initial_acknack_resets = drawn.initial_acknack_resets;
  scenario.dds.amendments->initial_acknack_arms = drawn.initial_acknack_arms;
  scenario.dds.amendments->count_filter = drawn.count_filter;
  scenario.dds.amendments->heartbeat_policy = drawn.heartbeat_policy;
  // The oracle does not look whether all is quiet.
  if (scenario.run_until == model::RunUntil::quiescence) {
    scenario.run_until = model::RunUntil::time_limit;
  }
  // Who falls silent for ever is missing for ever.
  if (seed % 4 != 0) scenario.deployment.life->mute.clear();
  return scenario;
}

/// A scenario of Fast DDS with a life.
model::Scenario living_fastdds(std::uint64_t seed) {
  model::Scenario scenario = random_fastdds_scenario(seed);
  props::Dice dice{seed};
  props::draw_life(dice, scenario);
  if (seed % 4 != 0) scenario.deployment.life->mute.clear();
  return scenario;
}

using Draw = model::Scenario(std::uint64_t);

/// `least_changed`: so many of them at least are complete though endpoints come and go.
void expect_equal_runs(Draw& living, std::size_t least_changed) {
  std::size_t complete = 0;
  std::size_t recovered = 0;
  std::size_t changed = 0;
  for (std::uint64_t seed = 1; seed <= 1'000; ++seed) {
    const model::Scenario scenario = living(seed);
    ASSERT_TRUE(model::config::is_valid(scenario)) << seed;
    const auto difference = oracle::difference(scenario);
    ASSERT_FALSE(difference) << "seed " << seed << ": " << *difference;
    model::RunOptions options;
    options.max_events = most_compared_events;
    const model::RunResult result = model::simulate(scenario, options);
    complete += result.completed() ? 1U : 0U;
    recovered += result.recovery_time && result.recovery_time->count() > 0 ? 1U : 0U;
    const bool with_changes = !scenario.deployment.life->endpoints.empty();
    changed += with_changes && result.completed() ? 1U : 0U;
  }
  std::cout << complete << " of 1000 lives are complete, " << recovered << " after a failure, "
            << changed << " with changes of endpoints\n";
  EXPECT_GE(complete, 80U);
  EXPECT_GE(recovered, 40U);
  EXPECT_GE(changed, least_changed);
}

TEST(Life, IsThatOfTheOracle) { expect_equal_runs(living, 20); }

/// Whose endpoints come and go with their participants only.
TEST(Life, IsThatOfTheOracleOfFastDds) { expect_equal_runs(living_fastdds, 0); }

/// Where nothing happens to anybody, the rules with a life are those without.
TEST(Life, OfNobodyWhoFailsIsFastDds) {
  for (std::uint64_t seed = 1; seed <= 100; ++seed) {
    model::Scenario scenario = random_fastdds_scenario(seed);
    const Observed without = observe_product(scenario, nullptr, most_compared_events);
    scenario.deployment.life.emplace();
    const Observed with = observe_product(scenario, nullptr, most_compared_events);
    EXPECT_EQ(first_difference(with, without), std::nullopt) << seed;
  }
}

class Effects final : public model::Probe {
 public:
  [[nodiscard]] bool wants_effects() const override { return true; }
  void effect(fsm::composition::EffectKey key) override { seen.insert(key); }

  std::set<fsm::composition::EffectKey> seen;
};

/// Every effect of the rules about lives happens in some of them.
void expect_all_effects(Draw& living, std::size_t least) {
  Effects effects;
  for (std::uint64_t seed = 1; seed <= 200; ++seed) {
    model::RunOptions options;
    options.probe = &effects;
    options.max_events = most_compared_events;
    (void)model::simulate(living(seed), options);
  }
  const auto& composition = model::composition_of(living(1));
  std::set<std::string> never;
  std::size_t known = 0;
  for (const auto& [key, id] : fsm::composition::effect_ids(composition)) {
    const std::string rule = id.substr(0, id.find('.'));
    constexpr std::array of_lives{"HearFrom",       "LeaseIsChecked", "Forget",
                                  "ForgetReader",   "ForgetWriter",   "Returns",
                                  "EndpointChanges"};
    if (std::ranges::find(of_lives, rule) == of_lives.end()) continue;
    ++known;
    if (!effects.seen.contains(key)) never.insert(id);
  }
  EXPECT_EQ(never, std::set<std::string>{});
  EXPECT_GE(known, least);
}

TEST(Life, EveryEffectHappens) { expect_all_effects(living, 31); }

TEST(Life, EveryEffectHappensInFastDds) { expect_all_effects(living_fastdds, 29); }

/// Each mistake about lives shows in some of them.
template <class Kind>
void expect_all_noticed(Draw& living, std::size_t first, std::size_t count) {
  for (std::size_t k = first; k < count; ++k) {
    const auto mistake = static_cast<Kind>(k);
    bool noticed = false;
    for (std::uint64_t seed = 1; seed <= 400 && !noticed; ++seed) {
      const model::Scenario scenario = living(seed);
      const Observed product = observe_product(scenario, nullptr, most_compared_events);
      const Observed wrong = observe_oracle(scenario, mistake, most_compared_events);
      noticed = first_difference(product, wrong).has_value();
    }
    EXPECT_TRUE(noticed) << name_of(mistake);
  }
}

TEST(Life, MistakesOfTheOracleAreNoticed) {
  expect_all_noticed<Mistake>(living, first_mistake_of_life, mistake_count);
}

TEST(Life, MistakesOfTheOracleOfFastDdsAreNoticed) {
  expect_all_noticed<FastddsMistake>(living_fastdds, first_fastdds_mistake_of_life,
                                     first_fastdds_mistake_of_versions);
}

}  // namespace life_oracle_test
}  // namespace stormproof::oracle
