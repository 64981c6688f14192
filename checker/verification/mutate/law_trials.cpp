// Holds the laws against a simulator with the mutant's mistake in it. Where the mutant changes
// knobs, every scenario that a law runs is changed; a law that only compares runs with each other
// then compares correct runs of other scenarios, and rightly sees nothing. A law is not asked if no
// run that it looks at comes to the mistake.
#include "checker/verification/mutate/law_trials.hpp"

#include <algorithm>

#include "model/simulator.hpp"
#include "model/trace/probe_list.hpp"

namespace stormproof::mutate {

namespace {

/// Enough for every trial without a mutant; mutants may schedule events without end.
constexpr std::uint64_t most_events = 20'000;

props::Simulate simulator(const checker::Mutant& mutant) {
  return [&mutant](const model::Scenario& scenario, model::Probe* probe) {
    model::RunOptions options;
    options.probe = probe;
    options.max_events = most_events;
    options.mutation = &mutant.rules;
    if (!mutant.knobs) return model::simulate(scenario, options);
    model::Scenario other = scenario;
    mutant.knobs(other);
    return model::simulate(other, options);
  };
}

/// Without a mutant. What happens in the runs is added to `happened`.
props::Simulate correct_simulator(Happened& happened) {
  return [&happened](const model::Scenario& scenario, model::Probe* probe) {
    EffectProbe effects{happened};
    model::trace::ProbeList probes;
    if (probe != nullptr) probes.add(*probe);
    probes.add(effects);
    model::RunOptions options;
    options.probe = &probes;
    options.max_events = most_events;
    return model::simulate(scenario, options);
  };
}

/// Whether the law can be broken by the mutant, if this happens in its runs without one.
bool may_break(const CatalogueEntry& entry, const Happened& happened) {
  const std::vector<fsm::composition::EffectMutation>& mistakes = entry.mutant.rules.effects;
  return mistakes.empty() || std::ranges::any_of(mistakes, [&](const auto& mistake) {
           return may_change(mistake, happened);
         });
}

}  // namespace

bool shows_in_runs(const checker::Mutant& mutant) {
  return !mutant.rules.tables.empty() || !mutant.rules.events.empty() ||
         !mutant.rules.effects.empty() || mutant.rules.live_bitmaps || mutant.knobs;
}

const std::vector<LawTrials::Ground>& LawTrials::grounds(model::ImplementationKind implementation) {
  const std::lock_guard lock{drawing_};
  std::vector<Ground>& list = grounds_[model::index_of(implementation)];
  if (!list.empty()) return list;
  const std::span<const props::Law> laws = props::laws();
  for (Trial& trial : trials(implementation)) {
    Ground ground{std::move(trial), {}};
    const model::Scenario& scenario = ground.trial.scenario;
    for (std::size_t k = 0; k < laws.size(); ++k) {
      if (stopped()) return list;
      if (!props::speaks_of(laws[k], scenario)) continue;
      Kept kept{k, {}};
      if (laws[k].broken(scenario, correct_simulator(kept.happened))) continue;
      ground.kept.push_back(std::move(kept));
    }
    list.push_back(std::move(ground));
  }
  return list;
}

/// Adds to `kills` the laws that are broken on one scenario; those in it are not asked.
void LawTrials::ask(const Ground& ground, const CatalogueEntry& entry,
                    std::vector<bool>& kills) const {
  const model::Scenario& scenario = ground.trial.scenario;
  const props::Simulate simulate = simulator(entry.mutant);
  for (const Kept& kept : ground.kept) {
    const props::Law& law = props::laws()[kept.law];
    if (kills[kept.law] || !may_break(entry, kept.happened) || stopped()) continue;
    kills[kept.law] = law.broken(scenario, simulate).has_value();
  }
}

std::vector<std::string> LawTrials::killers(const CatalogueEntry& entry) {
  const std::span<const props::Law> laws = props::laws();
  std::vector<bool> kills(laws.size());
  for (const auto implementation : entry.concerns) {
    for (const Ground& ground : grounds(implementation)) ask(ground, entry, kills);
  }
  std::vector<std::string> ids;
  for (std::size_t k = 0; k < laws.size(); ++k) {
    if (kills[k]) ids.emplace_back(laws[k].id);
  }
  return ids;
}

}  // namespace stormproof::mutate
