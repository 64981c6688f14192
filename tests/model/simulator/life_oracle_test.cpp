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
  // Who falls silent for ever is missing for ever.
  if (seed % 4 != 0) scenario.deployment.life->mute.clear();
  return scenario;
}

TEST(Life, IsThatOfTheOracle) {
  std::size_t complete = 0;
  std::size_t recovered = 0;
  for (std::uint64_t seed = 1; seed <= 400; ++seed) {
    const model::Scenario scenario = living(seed);
    ASSERT_TRUE(model::config::is_valid(scenario)) << seed;
    const auto difference = oracle::difference(scenario);
    ASSERT_FALSE(difference) << "seed " << seed << ": " << *difference;
    model::RunOptions options;
    options.max_events = most_compared_events;
    const model::RunResult result = model::simulate(scenario, options);
    complete += result.completed() ? 1U : 0U;
    recovered += result.recovery_time && result.recovery_time->count() > 0 ? 1U : 0U;
  }
  std::cout << complete << " of 400 lives are complete, " << recovered << " after a failure\n";
  EXPECT_GE(complete, 40U);
  EXPECT_GE(recovered, 20U);
}

class Effects final : public model::Probe {
 public:
  [[nodiscard]] bool wants_effects() const override { return true; }
  void effect(fsm::composition::EffectKey key) override { seen.insert(key); }

  std::set<fsm::composition::EffectKey> seen;
};

/// Every effect of the rules about lives happens in some of them.
TEST(Life, EveryEffectHappens) {
  Effects effects;
  for (std::uint64_t seed = 1; seed <= 200; ++seed) {
    model::RunOptions options;
    options.probe = &effects;
    options.max_events = most_compared_events;
    (void)model::simulate(living(seed), options);
  }
  const auto& composition = model::composition_of(model::ImplementationKind::paper_amended);
  std::set<std::string> never;
  std::size_t known = 0;
  for (const auto& [key, id] : fsm::composition::effect_ids(composition)) {
    const std::string rule = id.substr(0, id.find('.'));
    constexpr std::array of_lives{"HearFrom",     "LeaseIsChecked", "Forget",
                                  "ForgetReader", "ForgetWriter",   "Returns"};
    if (std::ranges::find(of_lives, rule) == of_lives.end()) continue;
    ++known;
    if (!effects.seen.contains(key)) never.insert(id);
  }
  EXPECT_EQ(never, std::set<std::string>{});
  EXPECT_GT(known, 30U);
}

/// Each mistake about lives shows in some of them.
TEST(Life, MistakesOfTheOracleAreNoticed) {
  for (std::size_t k = first_mistake_of_life; k < mistake_count; ++k) {
    const auto mistake = static_cast<Mistake>(k);
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

}  // namespace life_oracle_test
}  // namespace stormproof::oracle
