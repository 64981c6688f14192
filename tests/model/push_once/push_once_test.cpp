// A third composition in the simulator, on the page, and mutated: rules and a host of its own, and
// not a line elsewhere.
#include <gtest/gtest.h>

#include "fsm/program/record.hpp"
#include "fsm/program/words.hpp"
#include "model/engine/implementation_maker.hpp"
#include "model/simulator.hpp"
#include "tests/model/push_once/push_once_host.hpp"
#include "tests/model/run_log.hpp"

namespace stormproof::model {
namespace push_once_test {

using fsm::composition::CompositionInfo;
using fsm::composition::EffectMutation;

CompositionInfo composition() {
  return words_of(fsm::program::recorded<rules_of_push_once::PushOnce>());
}

RunResult run(const Scenario& scenario, const Mutation* mutation = nullptr) {
  RunOptions options;
  options.mutation = mutation;
  options.max_events = 10'000;
  return simulate(scenario, options, maker_of<PushOnceHost>(SameHostPairs::left_out));
}

Scenario two_by_two() { return by_hand({{0, 70}, {1, 3}, {1, 5}}); }

TEST(PushOnce, ForgetsNothing) {
  EXPECT_TRUE(fsm::composition::what_is_forgotten(composition()).empty());
}

TEST(PushOnce, CompletesIfNothingIsLost) {
  const RunResult result = run(two_by_two());
  EXPECT_TRUE(result.completed());
  EXPECT_EQ(result.missing_count, 0U);
}

TEST(PushOnce, NeverRepeatsWhatIsLost) {
  Scenario scenario = two_by_two();
  const RunResult correct = run(scenario);
  bool incomplete = false;
  for (std::uint64_t packet = 0; packet < correct.events; ++packet) {
    scenario.wireless.lost_packets = {packet};
    incomplete = incomplete || !run(scenario).completed();
  }
  EXPECT_TRUE(incomplete);
}

/// Of mistakes at its effects most are seen in three runs: one that completes, one that goes on,
/// and one that loses packets.
TEST(PushOnce, IsMutated) {
  std::vector<Scenario> scenarios(3, two_by_two());
  scenarios[1].run_until = RunUntil::time_limit;
  scenarios[2].wireless.lost_packets = {2, 5, 6, 9, 12};
  const auto mutations = fsm::composition::effect_mutations(composition());
  std::size_t noticed = 0;
  for (const EffectMutation& mistake : mutations) {
    Mutation mutation;
    mutation.effects.push_back(mistake);
    const bool differs = std::ranges::any_of(scenarios, [&](const Scenario& scenario) {
      const RunResult correct = run(scenario);
      const RunResult wrong = run(scenario, &mutation);
      return wrong.events != correct.events || wrong.end_time != correct.end_time;
    });
    if (differs) ++noticed;
  }
  EXPECT_GT(mutations.size(), 50U);
  EXPECT_GE(2 * noticed, mutations.size()) << noticed << " of " << mutations.size();
}

}  // namespace push_once_test
}  // namespace stormproof::model
