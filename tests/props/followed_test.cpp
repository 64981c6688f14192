// composition.followed: correct runs are what the rules say, and a mistake at an effect that
// changes what a run does is noticed.
#include <map>
#include <set>
#include <string>

#include <gtest/gtest.h>

#include "fsm/composition/compositions.hpp"
#include "props/laws/run_log.hpp"
#include "tests/oracle/random_scenario.hpp"
#include "tests/props/monitored_run.hpp"

namespace stormproof::props {
namespace followed_test {

using fsm::composition::EffectMutation;
using model::ImplementationKind;
using model::Scenario;

std::unique_ptr<Monitor> follow(const Scenario& scenario, model::RunOptions options = {}) {
  std::unique_ptr<Monitor> monitor = make_monitor("composition.followed", scenario);
  options.probe = monitor.get();
  (void)simulate(scenario, options);
  return monitor;
}

class Followed : public testing::TestWithParam<ImplementationKind> {};

TEST_P(Followed, CorrectRuns) {
  for (std::uint64_t seed = 0; seed < 300; ++seed) {
    Scenario scenario = oracle::random_scenario(seed, GetParam());
    if (seed % 2 == 1) scenario.run_until = model::RunUntil::time_limit;
    const auto monitor = follow(scenario);
    if (monitor->violation()) {
      ADD_FAILURE() << "seed " << seed << ", event " << monitor->violation()->event << ": "
                    << monitor->violation()->reason;
    }
  }
}

/// Of the mistakes at effects, those that change what some run does are noticed.
TEST_P(Followed, MistakesAtEffects) {
  std::vector<Scenario> scenarios;
  std::vector<RunLog> correct;
  model::RunOptions options;
  options.max_events = 5'000;
  std::uint64_t events = 0;
  for (std::uint64_t seed = 1; seed <= 40; ++seed) {
    scenarios.push_back(oracle::random_scenario(seed, GetParam()));
    options.probe = &correct.emplace_back();
    events += simulate(scenarios.back(), options).events;
  }
  std::cout << events << " events\n";
  std::map<std::string, std::array<int, 3>> by_change;
  for (const auto& composition : fsm::composition::compositions()) {
    if ((composition.name == "paper") != (GetParam() == ImplementationKind::paper)) continue;
    for (const EffectMutation& mistake : fsm::composition::effect_mutations(composition)) {
      model::Mutation mutation;
      mutation.effects.push_back(mistake);
      options.mutation = &mutation;
      bool noticed = false;
      std::string differs;
      for (std::size_t k = 0; k < scenarios.size() && !noticed; ++k) {
        noticed = follow(scenarios[k], options)->violation().has_value();
        if (noticed || !differs.empty()) continue;
        RunLog log;
        options.probe = &log;
        (void)simulate(scenarios[k], options);
        const auto found = first_difference(log, correct[k]);
        if (found) differs = std::to_string(k) + ": " + *found;
      }
      auto& counts = by_change[std::string{word_of(mistake.change)}];
      ++counts[0];
      if (noticed) ++counts[1];
      if (!noticed && !differs.empty()) {
        ++counts[2];
        std::cout << mistake.effect << " " << word_of(mistake.change) << " " << mistake.what
                  << " seed index " << differs << "\n";
      }
    }
  }
  for (const auto& [change, counts] : by_change) {
    std::cout << change << ": " << counts[0] << " noticed " << counts[1] << " unnoticed "
              << counts[2] << "\n";
  }
}

INSTANTIATE_TEST_SUITE_P(Both, Followed,
                         testing::Values(ImplementationKind::paper, ImplementationKind::fastdds));

}  // namespace followed_test
}  // namespace stormproof::props
