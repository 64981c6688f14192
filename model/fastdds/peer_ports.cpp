// Who is at which port, and whether it is one that is asked.
#include "model/fastdds/peer_ports.hpp"

#include <algorithm>

namespace stormproof::model::fastdds {

std::map<HostId, std::vector<std::uint32_t>> participants_at_ports(const Deployment& deployment) {
  std::map<HostId, std::vector<std::uint32_t>> hosts;
  for (std::uint32_t i = 0; i < deployment.size(); ++i) {
    hosts[deployment.participants[i].host].push_back(i);
  }
  return hosts;
}

std::vector<bool> reached_by_announcements(const Scenario& scenario) {
  std::vector<bool> reached(scenario.deployment.size(), true);
  if (scenario.dds.discovery != Discovery::static_peers) return reached;
  for (const auto& [host, there] : participants_at_ports(scenario.deployment)) {
    for (std::size_t port = 0; port < there.size(); ++port) {
      reached[there[port]] =
          !some_profile(scenario, [&](const DdsProfile& dds) { return port >= dds.peer_ports; });
    }
  }
  return reached;
}

bool announcements_reach_all(const Scenario& scenario) {
  return std::ranges::all_of(reached_by_announcements(scenario), [](bool it) { return it; });
}

}  // namespace stormproof::model::fastdds
