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

void run(const model::Scenario& scenario, const model::Mutation* mutation, model::Probe& probe) {
  model::RunOptions options;
  options.probe = &probe;
  options.mutation = mutation;
  options.max_events = enough_events;
  (void)model::simulate(scenario, options);
}

/// A random scenario of the kind.
model::Scenario draw(std::uint64_t seed, model::ImplementationKind kind,
                     props::ScenarioSpace space) {
  space.implementation = model::implementation_of(kind);
  model::Scenario scenario = props::draw_scenario(seed, size, space);
  if (model::traits_of(kind).has_server) {
    using enum model::Discovery;
    props::draw_discovery(seed, seed % 2 == 1 ? server : super_client, scenario);
  }
  return scenario;
}

/// Many of the first packets are lost, and others come later than timers that wait for them.
void disturb_packets(props::Dice& dice, model::WirelessProfile& wireless) {
  constexpr std::uint64_t first_packets = 60;
  wireless.one_way = Nanoseconds{dice.among({0, 1'000, 1'000'000, 1'000'000})};
  wireless.lost_packets.clear();
  wireless.packet_delays.clear();
  const int lost = static_cast<int>(dice.among({0, 10, 30, 60}));
  const int late = static_cast<int>(dice.among({0, 10, 30}));
  for (std::uint64_t packet = 0; packet < first_packets; ++packet) {
    if (dice.chance(lost)) {
      wireless.lost_packets.push_back(packet);
    } else if (dice.chance(late)) {
      wireless.packet_delays.push_back(
          {packet, Nanoseconds{0}, Nanoseconds{dice.magnitude(1'000, 4'000'000'000)}});
    }
  }
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
  disturb_packets(dice, scenario.wireless);
  const model::ImplementationTraits& traits = model::traits_of(kind);
  if (traits.creates_endpoints_over_time) {
    for (model::Participant& one : scenario.deployment.participants) {
      one.endpoints_done = one.start + Nanoseconds{dice.among({0, 100, 1'000, 3'000}) * 1'000'000};
    }
  }
  if (traits.knows_lives && !traits.has_living_composition) props::draw_life(dice, scenario);
  scenario.time_limit = Nanoseconds{10'000'000'000};
  return scenario;
}

}  // namespace

std::vector<EffectTrials::Correct>& EffectTrials::drawn(model::ImplementationKind implementation) {
  std::vector<Correct>& list = drawn_[model::index_of(implementation)];
  for (std::uint64_t seed = 1; list.size() < runs && !stopped(); ++seed) {
    Correct& correct = list.emplace_back();
    correct.scenario =
        seed > plain ? draw_disturbed(seed, implementation) : draw(seed, implementation, {});
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
