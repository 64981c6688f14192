// Applies the edits one by one and keeps what is valid and simpler.
#include "props/generators/simpler.hpp"

#include "model/config/knobs/numeric_knobs.hpp"
#include "props/generators/edits.hpp"

namespace stormproof::props {

using model::Scenario;

Edits simplifying_edits(const Scenario& scenario, const Scenario& base) {
  Edits edits;
  edits.push_back([&base](Scenario& s) { s.dds = base.dds, s.wireless = base.wireless; });
  add_deployment_edits(scenario, edits);
  edits.push_back([&base](Scenario& s) { s.dds = base.dds; });
  edits.push_back([&base](Scenario& s) { s.wireless = base.wireless; });
  add_packet_edits(scenario, base, edits);
  add_route_edits(scenario, base, edits);
  add_reset_edits(scenario, base, edits);
  add_rounding_edits(scenario, base, edits);
  return edits;
}

std::optional<Scenario> edited(const Edit& edit, const Scenario& scenario, const Scenario& base,
                               const Complexity& of_scenario) {
  Scenario simpler = scenario;
  edit(simpler);
  if (simpler.deployment != scenario.deployment) simpler.deployment.schedule.reset();
  if (!(complexity(simpler, base) < of_scenario) || !model::config::is_valid(simpler)) {
    return std::nullopt;
  }
  return simpler;
}

std::optional<Scenario> first_simpler(const Scenario& scenario, const Scenario& base,
                                      const std::function<bool(const Scenario&)>& accepts) {
  const Complexity of_scenario = complexity(scenario, base);
  for (const Edit& edit : simplifying_edits(scenario, base)) {
    std::optional<Scenario> simpler = edited(edit, scenario, base, of_scenario);
    if (simpler && accepts(*simpler)) return simpler;
  }
  return std::nullopt;
}

std::vector<Scenario> simpler_scenarios(const Scenario& scenario, const Scenario& base) {
  std::vector<Scenario> list;
  const auto keep = [&list](const Scenario& simpler) { return list.push_back(simpler), false; };
  (void)first_simpler(scenario, base, keep);
  return list;
}

}  // namespace stormproof::props
