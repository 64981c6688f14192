// A random scenario, step by step.
#include "props/generators/draw.hpp"

namespace stormproof::props {

model::Scenario draw_scenario(std::uint64_t seed, int size, const ScenarioSpace& space) {
  using model::ImplementationKind;
  Dice dice{seed};
  model::Scenario scenario;
  const bool is_fastdds = dice.chance(40);
  scenario.dds.implementation = space.implementation.value_or(
      is_fastdds ? ImplementationKind::fastdds : ImplementationKind::paper);
  draw_participants(dice, space, size, scenario);
  draw_rules_and_sizes(dice, scenario);
  draw_wireless(dice, space, scenario.wireless);
  const Clock clock = draw_clock(dice, space, scenario);
  draw_packet_delays(dice, clock, scenario.wireless);
  draw_timers(dice, clock, scenario.dds);
  draw_times(dice, space, clock, scenario);
  draw_attempts(dice, clock, scenario.dds.sedp);
  return scenario;
}

}  // namespace stormproof::props
