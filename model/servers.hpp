// Who the Discovery Servers of a deployment are and whose: they are numbered after all
// participants, in the order in which the deployment lists them. Only where participants discover
// through a server (`ImplementationTraits::has_server`). Source: specs/guide/discovery-server.md,
// "Several servers".
#pragma once

#include <algorithm>
#include <cstdint>
#include <vector>

#include "model/deployment.hpp"

namespace stormproof::model {

/// A deployment that lists none has one.
[[nodiscard]] inline std::uint32_t server_count(const Deployment& deployment) {
  return std::max<std::uint32_t>(1, static_cast<std::uint32_t>(deployment.servers.size()));
}
[[nodiscard]] inline HostId host_of_server(const Deployment& deployment, std::uint32_t k) {
  return k < deployment.servers.size() ? deployment.servers[k].host : HostId{};
}
/// Those of a participant, ascending, as participants are numbered.
[[nodiscard]] inline std::vector<std::uint32_t> servers_of(const Deployment& deployment,
                                                           std::uint32_t participant) {
  const std::vector<std::uint64_t>& chosen = deployment.participants[participant].servers;
  std::vector<std::uint32_t> servers;
  for (std::uint32_t k = 0; k < server_count(deployment); ++k) {
    if (chosen.empty() || std::ranges::find(chosen, k) != chosen.end())
      servers.push_back(deployment.size() + k);
  }
  return servers;
}
/// Those that a server looks for, as participants are numbered.
[[nodiscard]] inline std::vector<std::uint32_t> servers_sought_by(const Deployment& deployment,
                                                                  std::uint32_t server) {
  std::vector<std::uint32_t> sought;
  if (deployment.servers.empty()) return sought;
  for (const std::uint64_t k : deployment.servers[server - deployment.size()].servers) {
    sought.push_back(deployment.size() + static_cast<std::uint32_t>(k));
  }
  return sought;
}

}  // namespace stormproof::model
