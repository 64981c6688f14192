// Draws the runs, and holds mutants against them.
#include "checker/verification/mutate/effect_trials.hpp"

#include <algorithm>

#include "model/simulator.hpp"
#include "props/generators/on_demand.hpp"
#include "props/generators/space.hpp"
#include "props/monitor.hpp"

namespace stormproof::mutate {

namespace {

using model::Nanoseconds;

/// Mutants may schedule events without end.
constexpr std::uint64_t enough_events = 5'000;
constexpr int size = 50;
/// The first runs are of any kind; in the others things go wrong.
constexpr std::uint64_t plain = 40;

model::RunResult run(const model::Scenario& scenario, const model::Mutation* mutation,
                     model::Probe& probe) {
  model::RunOptions options;
  options.probe = &probe;
  options.mutation = mutation;
  options.max_events = enough_events;
  return model::simulate(scenario, options);
}

/// Who objects to the correct run of the scenario.
Ids judged(const model::Scenario& scenario) {
  Onlookers onlookers{scenario};
  const model::RunResult result = run(scenario, nullptr, onlookers.probe());
  return onlookers.objections(scenario, result);
}

/// A random scenario of the kind.
model::Scenario draw(std::uint64_t seed, model::ImplementationKind kind,
                     props::ScenarioSpace space) {
  space.implementation = model::implementation_of(kind);
  model::Scenario scenario = props::draw_scenario(seed, size, space);
  if (model::traits_of(kind).has_server) {
    using enum model::Discovery;
    props::draw_discovery(seed, seed % 2 == 1 ? server : super_client, scenario);
    props::Dice dice{seed};
    if (seed % 3 == 2) props::draw_servers(dice, scenario);
  }
  return scenario;
}

/// What rules do only if something goes wrong: few participants over a network that loses much and
/// delivers late, with endpoints that come late and, where the rules know them, participants that
/// come back.
model::Scenario draw_disturbed(std::uint64_t seed, model::ImplementationKind kind) {
  model::Scenario scenario = draw(seed, kind,
                                  {.service = model::ServiceKind::constant_delay,
                                   .max_participants = 3,
                                   .max_endpoints = 2,
                                   .run_until = model::RunUntil::time_limit});
  props::Dice dice{seed};
  props::draw_disturbances(dice, scenario);
  const model::ImplementationTraits& traits = model::traits_of(kind);
  if (traits.knows_lives && !traits.has_living_composition) props::draw_life(dice, scenario);
  scenario.time_limit = Nanoseconds{10'000'000'000};
  return scenario;
}

bool same_times(const props::RunLog& one, const props::RunLog& other) {
  const auto same = [](const props::RunLog::Entry& a, const props::RunLog::Entry& b) {
    return a.time == b.time && a.kind == b.kind;
  };
  return std::ranges::equal(one.entries(), other.entries(), same);
}

/// Of a run that differs from the correct one. One that was cut off has sent without end.
Harm harm(const model::RunResult& correct, const model::RunResult& mistaken) {
  if (mistaken.end == model::RunEnd::interrupted) return Harm::messages;
  if (correct.missing_count < mistaken.missing_count) return Harm::discovery;
  const bool same_counts = correct.counts == mistaken.counts &&
                           correct.user_control == mistaken.user_control &&
                           correct.duplicate_deliveries == mistaken.duplicate_deliveries;
  return same_counts ? Harm::time : Harm::messages;
}

/// The first, the last, the second, the last but one, …
template <class Item>
std::vector<Item> from_both_ends(std::vector<Item> list) {
  std::vector<Item> mixed;
  std::size_t end = list.size();
  for (std::size_t first = 0; first < end; ++first) {
    mixed.push_back(std::move(list[first]));
    if (--end > first) mixed.push_back(std::move(list[end]));
  }
  return mixed;
}

}  // namespace

const std::vector<EffectTrials::Correct>& EffectTrials::drawn(
    model::ImplementationKind implementation) {
  const std::lock_guard lock{drawing_};
  std::vector<Correct>& list = drawn_[model::index_of(implementation)];
  if (list.size() == runs) return list;
  for (std::uint64_t seed = 1; list.size() < runs && !stopped(); ++seed) {
    Correct& correct = list.emplace_back();
    correct.scenario =
        seed > plain ? draw_disturbed(seed, implementation) : draw(seed, implementation, {});
    EffectProbe effects{correct.happened};
    model::trace::ProbeList probes;
    probes.add(correct.log);
    probes.add(effects);
    correct.result = run(correct.scenario, nullptr, probes);
    correct.objections = judged(correct.scenario);
  }
  const auto length = [](const Correct& correct) { return correct.log.entries().size(); };
  std::ranges::stable_sort(list, {}, length);
  list = from_both_ends(std::move(list));
  return list;
}

EffectTrials::Mistaken EffectTrials::run_with(const CatalogueEntry& entry, const Correct& correct,
                                              bool is_watched) {
  Mistaken mistaken;
  const model::Mutation* const rules = &entry.mutant.rules;
  if (!is_watched) {
    mistaken.result = run(correct.scenario, rules, mistaken.log);
    return mistaken;
  }
  Onlookers onlookers{correct.scenario, correct.objections};
  onlookers.add(mistaken.log);
  mistaken.result = run(correct.scenario, rules, onlookers.probe());
  mistaken.objections = onlookers.objections(correct.scenario, mistaken.result);
  return mistaken;
}

/// Onlookers watch from the beginning if the run before differed, as the next will, too.
EffectFindings EffectTrials::try_out(const CatalogueEntry& entry) {
  EffectFindings found;
  std::uint64_t differing = 0;
  bool is_likely = false;
  for (const Correct& correct : drawn(entry.concerns.front())) {
    if (stopped() || differing == differing_runs) break;
    if (!may_change(entry.mutant.rules.effects.front(), correct.happened)) continue;
    Mistaken mistaken = run_with(entry, correct, is_likely);
    is_likely = props::first_difference(mistaken.log, correct.log).has_value();
    if (!is_likely) continue;
    ++differing;
    const bool timely = same_times(mistaken.log, correct.log);
    const Harm worst = timely ? Harm::nothing : harm(correct.result, mistaken.result);
    found.harm = std::max(found.harm, worst);
    if (!mistaken.objections) mistaken = run_with(entry, correct, true);
    found.objections = *std::move(mistaken.objections);
    if (!found.objections.empty()) break;
    if (!found.are_followed) continue;
    const auto monitor = props::make_monitor(followed, correct.scenario);
    run(correct.scenario, &entry.mutant.rules, *monitor);
    found.are_followed = !monitor->violation();
  }
  return found;
}

}  // namespace stormproof::mutate
