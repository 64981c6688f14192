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

const char* end_name(RunEnd end) {
  switch (end) {
    case RunEnd::completed:
      return "completed";
    case RunEnd::time_limit:
      return "time_limit";
    case RunEnd::no_more_events:
      return "no_more_events";
    case RunEnd::interrupted:
      return "interrupted";
  }
  return "";
}

}  // namespace stormproof::model::trace
