// A random scenario, step by step.
#include "props/generators/draw.hpp"

namespace stormproof::props {

namespace {

/// The default one, or in 40 % any other that engines and laws know.
model::ImplementationKind draw_implementation(Dice& dice) {
  const bool is_other = dice.chance(40);
  std::vector<model::ImplementationKind> others = model::known_to_engines();
  std::erase(others, model::default_implementation);
  if (!is_other) return model::default_implementation;
  return others.size() == 1 ? others.front() : dice.pick(others);
}

}  // namespace

model::Scenario draw_scenario(std::uint64_t seed, int size, const ScenarioSpace& space) {
  Dice dice{seed};
  model::Scenario scenario;
  scenario.dds.implementation = space.implementation.value_or(draw_implementation(dice));
  draw_participants(dice, space, size, scenario);
  draw_rules_and_sizes(dice, scenario);
  draw_wireless(dice, space, scenario.wireless);
  const Clock clock = draw_clock(dice, space, scenario);
  draw_packet_delays(dice, clock, scenario.wireless);
  draw_timers(dice, clock, scenario.dds);
  draw_times(dice, space, clock, scenario);
  draw_attempts(dice, clock, scenario.dds.sedp);
  draw_notification(dice, scenario.dds);
  return scenario;
}

}  // namespace stormproof::props
