// Channel names, as the network numbers them.
#include "model/trace/scenario_names.hpp"

#include <algorithm>

#include "model/engine/fleet.hpp"

namespace stormproof::model::trace {

std::vector<std::string> channel_names(const Scenario& scenario) {
  const WirelessProfile& wireless = scenario.wireless;
  std::vector<std::string> names;
  if (wireless.kind == ServiceKind::constant_delay) return names;
  for (const Stage& stage : wireless.stages) {
    if (std::ranges::find(names, stage.channel) == names.end()) names.push_back(stage.channel);
  }
  const std::vector<std::string> radios = Fleet{scenario}.radios();
  if (radios.size() == 1) return names;
  std::vector<std::string> all;
  for (const std::string& radio : radios) {
    for (const std::string& name : names) all.push_back(radio + " " + name);
  }
  return all;
}

std::string program_name() { return "stormproof " STORMPROOF_VERSION; }

}  // namespace stormproof::model::trace
