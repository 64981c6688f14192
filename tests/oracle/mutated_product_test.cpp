// Deliberate mistakes of the product (`stormproof mutate`'s catalogue): the comparison with the
// oracle notices every one that can be noticed in a run.
#include <algorithm>
#include <iostream>
#include <map>

#include <gtest/gtest.h>

#include "checker/verification/mutate/mutants.hpp"
#include "tests/oracle/judged_runs.hpp"
#include "tests/oracle/sharp_scenario.hpp"

namespace stormproof::oracle {
namespace mutated_product_test {

using model::ImplementationKind;
using mutate::CatalogueEntry;
using mutate::Concerns;
using Ids = std::vector<std::string>;

constexpr std::size_t tries = 1'000;

bool runs_differently(const CatalogueEntry& entry) {
  const model::Mutation& rules = entry.mutant.rules;
  return !rules.tables.empty() || !rules.events.empty() || !rules.effects.empty() ||
         rules.live_bitmaps || entry.mutant.knobs;
}

/// The oracle has no such rules: `stormproof mutate` runs them on scenarios of their own.
bool is_about_amended_rules(const CatalogueEntry& entry) {
  constexpr std::uint64_t enough = 100;
  for (std::uint64_t seed = 0; entry.mutant.knobs && seed < enough; ++seed) {
    const model::Scenario scenario = varied_scenario(seed);
    model::Scenario changed = scenario;
    entry.mutant.knobs(changed);
    if (changed != scenario) return false;
  }
  return static_cast<bool>(entry.mutant.knobs);
}

bool notices(const JudgedRun& run, const checker::Mutant& mutant) {
  model::Scenario scenario = run.scenario;
  if (mutant.knobs) mutant.knobs(scenario);
  // A run that is longer than the oracle's differs already.
  const std::uint64_t enough = run.correct.events.size() + 1;
  const Observed wrong = observe_product(scenario, &mutant.rules, enough);
  return first_difference(wrong, run.correct).has_value();
}

/// The mutants of an implementation that no scenario shows.
Ids unnoticed(JudgedRuns& runs, ImplementationKind own) {
  Ids list;
  std::size_t count = 0;
  std::size_t most = 0;
  for (const CatalogueEntry& entry : mutate::mutants()) {
    const Concerns& concerns = entry.concerns;
    if (std::ranges::find(concerns, own) == concerns.end() || !runs_differently(entry)) continue;
    if (entry.kind == mutate::Kind::effect) continue;  // too many; see the mutants' own test
    if (is_about_amended_rules(entry)) continue;
    const std::size_t needed =
        runs.tries_until(tries, [&](const JudgedRun& run) { return notices(run, entry.mutant); });
    if (needed > tries) list.push_back(entry.mutant.id);
    if (needed <= tries) most = std::max(most, needed);
    ++count;
  }
  std::cout << count << " mutants, " << list.size() << " unnoticed, the others after at most "
            << most << " scenarios\n";
  return list;
}

Observed correct_oracle(const model::Scenario& scenario, std::uint64_t max_events) {
  return observe_oracle(scenario, max_events);
}

/// attempts-never-end: ignores the guard of the row that tries again. Where the guard is false, the
/// row that ends the attempts is enabled as well, and of two enabled rows the later one wins: the
/// table does what it did. (`fsm.determinism` notices it, in the table itself.)
Ids cannot_be_noticed() { return {"attempts-never-end"}; }

/// Mutants of the order of events are proved about, not run: the run's order is the queue's own.
/// The same mistakes are in the oracle (`class_ignored`, `dispatch_first`).
TEST(MutatedProduct, OnlyMutantsOfTheOrderDoNotRun) {
  Ids list;
  for (const CatalogueEntry& entry : mutate::mutants()) {
    if (!runs_differently(entry)) list.push_back(entry.mutant.id);
  }
  EXPECT_EQ(list, (Ids{"order-pairwise", "order-without-insertion", "order-without-class"}));
}

TEST(MutatedProduct, KnobsOfAmendedRulesAreNotTheOracles) {
  Ids list;
  for (const CatalogueEntry& entry : mutate::mutants()) {
    if (is_about_amended_rules(entry)) list.push_back(entry.mutant.id);
  }
  EXPECT_EQ(list, (Ids{"attempts-end-early", "attempt-at-the-same-instant", "late-attempt-resets",
                       "acknack-answered-at-once", "waits-for-the-dead", "announces-to-all",
                       "charged-with-everything"}));
}

TEST(MutatedProduct, EveryPaperMutantIsNoticedThatCanBe) {
  JudgedRuns runs{varied_scenario, correct_oracle};
  EXPECT_EQ(unnoticed(runs, ImplementationKind::paper), cannot_be_noticed());
}

TEST(MutatedProduct, EveryFastddsMutantIsNoticedThatCanBe) {
  JudgedRuns runs{varied_fastdds_scenario, correct_oracle};
  EXPECT_EQ(unnoticed(runs, ImplementationKind::fastdds), cannot_be_noticed());
}

TEST(MutatedProduct, EveryCycloneMutantIsNoticedThatCanBe) {
  JudgedRuns runs{varied_cyclone_scenario, correct_oracle};
  EXPECT_EQ(unnoticed(runs, ImplementationKind::cyclone), Ids{});
}

}  // namespace mutated_product_test
}  // namespace stormproof::oracle
