// Holds the laws against a simulator with the mutant's mistake in it. Where the mutant changes
// knobs, every scenario that a law runs is changed; a law that only compares runs with each other
// then compares correct runs of other scenarios, and rightly sees nothing.
#include "checker/verification/mutate/law_trials.hpp"

#include "model/simulator.hpp"

namespace stormproof::mutate {

namespace {

/// Enough for every trial without a mutant; mutants may schedule events without end.
constexpr std::uint64_t most_events = 20'000;

props::Simulate simulator(const checker::Mutant* mutant) {
  return [mutant](const model::Scenario& scenario, model::Probe* probe) {
    model::RunOptions options;
    options.probe = probe;
    options.max_events = most_events;
    if (mutant == nullptr) return model::simulate(scenario, options);
    options.mutation = &mutant->rules;
    if (!mutant->knobs) return model::simulate(scenario, options);
    model::Scenario other = scenario;
    mutant->knobs(other);
    return model::simulate(other, options);
  };
}

}  // namespace

bool shows_in_runs(const checker::Mutant& mutant) {
  return !mutant.rules.tables.empty() || !mutant.rules.events.empty() ||
         !mutant.rules.effects.empty() || mutant.rules.live_bitmaps || mutant.knobs;
}

std::vector<LawTrials::Ground>& LawTrials::grounds(model::ImplementationKind implementation) {
  std::vector<Ground>& list = grounds_[model::index_of(implementation)];
  if (!list.empty()) return list;
  const props::Simulate correct = simulator(nullptr);
  for (Trial& trial : trials(implementation)) {
    Ground ground{std::move(trial), {}};
    for (const props::Law& law : props::laws()) {
      if (goes_on_ && !goes_on_()) return list;
      const model::Scenario& scenario = ground.trial.scenario;
      ground.holds.push_back(props::speaks_of(law, scenario) && !law.broken(scenario, correct));
    }
    list.push_back(std::move(ground));
  }
  return list;
}

std::vector<std::string> LawTrials::killers(const CatalogueEntry& entry) {
  const std::span<const props::Law> laws = props::laws();
  const props::Simulate simulate = simulator(&entry.mutant);
  std::vector<bool> kills(laws.size());
  for (const auto implementation : entry.concerns) {
    for (const Ground& ground : grounds(implementation)) {
      for (std::size_t k = 0; k < laws.size(); ++k) {
        if (kills[k] || !ground.holds[k]) continue;
        if (goes_on_ && !goes_on_()) return {};
        kills[k] = laws[k].broken(ground.trial.scenario, simulate).has_value();
      }
    }
  }
  std::vector<std::string> ids;
  for (std::size_t k = 0; k < laws.size(); ++k) {
    if (kills[k]) ids.emplace_back(laws[k].id);
  }
  return ids;
}

}  // namespace stormproof::mutate
