// Draws the runs, and holds mutants against them.
#include "checker/verification/mutate/effect_trials.hpp"

#include <algorithm>

#include "model/simulator.hpp"
#include "props/generators/on_demand.hpp"
#include "props/generators/space.hpp"
#include "props/monitor.hpp"

namespace stormproof::mutate {

namespace {

/// Mutants may schedule events without end.
constexpr std::uint64_t enough_events = 5'000;
constexpr int size = 50;

void run(const model::Scenario& scenario, const model::Mutation* mutation, model::Probe& probe) {
  model::RunOptions options;
  options.probe = &probe;
  options.mutation = mutation;
  options.max_events = enough_events;
  (void)model::simulate(scenario, options);
}

/// A random scenario of the kind.
model::Scenario draw(std::uint64_t seed, model::ImplementationKind kind) {
  model::Scenario scenario =
      props::draw_scenario(seed, size, {.implementation = model::implementation_of(kind)});
  if (model::traits_of(kind).has_server) {
    using enum model::Discovery;
    props::draw_discovery(seed, seed % 2 == 1 ? server : super_client, scenario);
  }
  return scenario;
}

}  // namespace

std::vector<EffectTrials::Correct>& EffectTrials::drawn(model::ImplementationKind implementation) {
  std::vector<Correct>& list = drawn_[model::index_of(implementation)];
  for (std::uint64_t seed = 1; list.size() < runs && !stopped(); ++seed) {
    Correct& correct = list.emplace_back();
    correct.scenario = draw(seed, implementation);
    run(correct.scenario, nullptr, correct.log);
  }
  return list;
}

bool EffectTrials::are_followed(const CatalogueEntry& entry) {
  return std::ranges::none_of(drawn(entry.concerns.front()), [&](const Correct& correct) {
    if (stopped()) return false;
    const auto monitor = props::make_monitor("composition.followed", correct.scenario);
    run(correct.scenario, &entry.mutant.rules, *monitor);
    return monitor->violation().has_value();
  });
}

bool EffectTrials::makes_a_difference(const CatalogueEntry& entry) {
  return std::ranges::any_of(drawn(entry.concerns.front()), [&](const Correct& correct) {
    if (stopped()) return false;
    props::RunLog log;
    run(correct.scenario, &entry.mutant.rules, log);
    return props::first_difference(log, correct.log).has_value();
  });
}

}  // namespace stormproof::mutate
