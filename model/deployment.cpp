// Builds the homogeneous short form of a deployment and counts its hosts.
#include "model/deployment.hpp"

#include <set>

namespace stormproof::model {

Deployment Deployment::homogeneous(std::uint32_t hosts, std::uint32_t participants_per_host,
                                   std::uint32_t endpoints_per_participant) {
  Deployment deployment;
  const std::uint32_t publications = endpoints_per_participant - endpoints_per_participant / 2;
  for (std::uint32_t host = 0; host < hosts; ++host) {
    for (std::uint32_t k = 0; k < participants_per_host; ++k) {
      deployment.participants.push_back(
          {HostId{host}, publications, endpoints_per_participant / 2, Nanoseconds{0}, Nanoseconds{0}});
    }
  }
  return deployment;
}

std::uint32_t Deployment::host_count() const {
  std::set<HostId> hosts;
  for (const Participant& participant : participants) hosts.insert(participant.host);
  return static_cast<std::uint32_t>(hosts.size());
}

}  // namespace stormproof::model
