// composition.followed of a composition that nothing but tests knows (tests/model/push_once): it is
// audited as all others are, by its rules and contracts alone.
#include <memory>

#include <gtest/gtest.h>

#include "fsm/program/record.hpp"
#include "fsm/program/words.hpp"
#include "tests/model/push_once/push_once.hpp"
#include "tests/model/run_log.hpp"
#include "tests/props/push_once_runs.hpp"
#include "tests/props/run_digest.hpp"

namespace stormproof::props {
namespace new_composition_test {

using fsm::composition::EffectMutation;
using model::Scenario;
using Rules = fsm::composition::push_once::PushOnce;

std::unique_ptr<Monitor> audit(const Scenario& scenario,
                               const model::Mutation* mutation = nullptr) {
  std::unique_ptr<Monitor> monitor = watch_push_once(scenario);
  run_push_once(scenario, *monitor, mutation);
  return monitor;
}
std::uint64_t digest(const Scenario& scenario, const model::Mutation* mutation = nullptr) {
  RunDigest digest;
  run_push_once(scenario, digest, mutation);
  return digest.digest;
}

/// One that completes, one that goes on, and one that loses packets.
std::vector<Scenario> scenarios() {
  std::vector<Scenario> scenarios(3, model::by_hand({{0, 70}, {1, 3}, {1, 5}}));
  scenarios[1].run_until = model::RunUntil::time_limit;
  scenarios[2].wireless.lost_packets = {2, 5, 6, 9, 12};
  return scenarios;
}

TEST(NewComposition, RunsAreWhatItsRulesSay) {
  for (const Scenario& scenario : scenarios()) {
    const auto monitor = audit(scenario);
    EXPECT_FALSE(monitor->violation()) << monitor->violation()->reason;
  }
}

TEST(NewComposition, MistakesAtItsEffectsThatChangeARunAreNoticed) {
  std::size_t noticed = 0;
  const auto mistakes =
      fsm::composition::effect_mutations(fsm::program::words_of(fsm::program::recorded<Rules>()));
  for (const EffectMutation& mistake : mistakes) {
    model::Mutation mutation;
    mutation.effects.push_back(mistake);
    bool changes = false;
    bool found = false;
    for (const Scenario& scenario : scenarios()) {
      changes = changes || digest(scenario, &mutation) != digest(scenario);
      found = found || audit(scenario, &mutation)->violation().has_value();
    }
    EXPECT_EQ(found, changes) << mistake.effect << " " << word_of(mistake.change) << ": "
                              << mistake.what;
    if (found) ++noticed;
  }
  EXPECT_GT(2 * noticed, mistakes.size());
}

}  // namespace new_composition_test
}  // namespace stormproof::props
