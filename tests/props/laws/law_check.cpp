// RapidCheck's side of the tests of laws, compiled once.
#include "tests/props/laws/law_check.hpp"

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

bool applies_to(const Law& law, model::ImplementationKind implementation) {
  int applied = 0;
  for (std::uint64_t seed = 0; seed < 100; ++seed) {
    if (law.applies(draw_scenario(seed, 50, {.implementation = implementation}))) ++applied;
  }
  return applied > 5;
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
