// Channel names, as the network numbers them.
#include "model/trace/scenario_names.hpp"

#include <algorithm>

namespace stormproof::model::trace {

std::vector<std::string> channel_names(const WirelessProfile& wireless) {
  std::vector<std::string> names;
  if (wireless.kind == ServiceKind::constant_delay) return names;
  for (const Stage& stage : wireless.stages) {
    if (std::ranges::find(names, stage.channel) == names.end()) names.push_back(stage.channel);
  }
  return names;
}

std::string program_name() { return "stormproof " STORMPROOF_VERSION; }

}  // namespace stormproof::model::trace
