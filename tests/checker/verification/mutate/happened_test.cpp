// What spares mutants runs changes nothing of what they show: a run that never comes to a mistake
// is the run without it.
#include "checker/verification/mutate/happened.hpp"

#include <gtest/gtest.h>

#include "checker/verification/mutate/effect_mutants.hpp"
#include "checker/verification/mutate/trial_scenarios.hpp"
#include "model/simulator.hpp"
#include "props/laws/run_log.hpp"

namespace stormproof::mutate {
namespace happened_test {

model::RunResult run(const model::Scenario& scenario, model::Probe& probe,
                     const model::Mutation* mutation = nullptr) {
  model::RunOptions options;
  options.probe = &probe;
  options.mutation = mutation;
  options.max_events = 5'000;
  return model::simulate(scenario, options);
}

TEST(Happened, ARunThatNeverComesToAMistakeIsTheRunWithoutIt) {
  std::size_t never = 0;
  std::size_t changed = 0;
  std::size_t number = 0;
  for (const CatalogueEntry& entry : effect_mutants()) {
    if (entry.concerns.empty() || ++number % 5 != 0) continue;
    for (const Trial& trial : trials(entry.concerns.front())) {
      Happened happened;
      EffectProbe effects{happened};
      run(trial.scenario, effects);
      props::RunLog correct;
      run(trial.scenario, correct);
      props::RunLog mistaken;
      run(trial.scenario, mistaken, &entry.mutant.rules);
      const auto difference = props::first_difference(mistaken, correct);
      if (may_change(entry.mutant.rules.effects.front(), happened)) {
        changed += difference ? 1U : 0U;
      } else {
        ++never;
        EXPECT_FALSE(difference) << entry.mutant.id << " in " << trial.name << ": " << *difference;
      }
    }
  }
  EXPECT_GT(never, 100U);
  EXPECT_GT(changed, 100U);
}

}  // namespace happened_test
}  // namespace stormproof::mutate
