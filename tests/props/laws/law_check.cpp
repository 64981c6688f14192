// RapidCheck's side of the tests of laws, compiled once.
#include "tests/props/laws/law_check.hpp"

#include <algorithm>
#include <sstream>

#include <rapidcheck.h>
#include <rapidcheck/detail/TestListenerAdapter.h>

#include "model/simulator.hpp"
#include "props/generators/scenarios.hpp"
#include "props/generators/space.hpp"

namespace stormproof::props {

model::RunResult correct(const model::Scenario& scenario, model::Probe* probe) {
  model::RunOptions options;
  options.probe = probe;
  return model::simulate(scenario, options);
}

std::vector<Law> laws_of(model::ImplementationKind implementation) {
  std::vector<model::Scenario> drawn;
  for (std::uint64_t seed = 0; seed < 100; ++seed) {
    drawn.push_back(draw_scenario(seed, 50, {.implementation = implementation}));
  }
  std::vector<Law> list{laws().begin(), laws().end()};
  std::erase_if(list,
                [&](const Law& law) { return std::ranges::count_if(drawn, law.applies) <= 5; });
  return list;
}

std::optional<std::string> broken_on_random_scenarios(const Law& law, const Simulate& simulate,
                                                      const Effort& effort) {
  ScenarioSpace space;
  space.max_participants = 4;
  space.max_endpoints = 4;
  space.max_time_limit = model::Nanoseconds{5'000'000'000};
  space.implementation = effort.implementation;
  const auto property = [&] {
    const auto scenario = *rc::gen::suchThat(scenarios(space), law.applies);
    const std::optional<std::string> reason = law.broken(scenario, simulate);
    if (reason) RC_FAIL(*reason);
  };
  rc::detail::TestMetadata metadata;
  metadata.id = metadata.description = std::string{law.id};
  rc::detail::TestParams params;
  params.seed = 20'261'121;
  params.maxSuccess = effort.scenarios;
  params.disableShrinking = !effort.shrink;
  rc::detail::TestListenerAdapter quiet;
  const rc::detail::TestResult result =
      rc::detail::checkTestable(property, metadata, params, quiet);
  if (result.is<rc::detail::SuccessResult>()) return std::nullopt;
  std::ostringstream text;
  rc::detail::printResultMessage(result, text);
  return text.str();
}

}  // namespace stormproof::props
