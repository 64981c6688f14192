// Builds the homogeneous short form of a deployment, draws schedules, counts hosts.
#include "model/deployment.hpp"

#include <algorithm>
#include <map>
#include <random>
#include <set>

#include "model/nodes.hpp"

namespace stormproof::model {

Deployment Deployment::homogeneous(std::uint32_t hosts, std::uint32_t participants_per_host,
                                   std::uint32_t endpoints_per_participant,
                                   std::uint32_t nodes_per_participant) {
  Deployment nodes;
  const std::uint32_t subscriptions = endpoints_per_participant / 2;
  const std::uint32_t publications = endpoints_per_participant - subscriptions;
  for (std::uint32_t host = 0; host < hosts; ++host) {
    for (std::uint32_t k = 0; k < participants_per_host; ++k) {
      nodes.participants.push_back(
          {HostId{host}, publications, subscriptions, Nanoseconds{0}, Nanoseconds{0}});
    }
  }
  return sharing_participants(nodes, nodes_per_participant);
}

void Deployment::draw_schedule(std::uint64_t seed) {
  schedule->seed = seed;
  std::mt19937_64 random{seed};  // its sequence is fixed by the standard; distributions are not
  const auto draw = [&](Nanoseconds low, Nanoseconds high) {
    const auto values = static_cast<std::uint64_t>((high - low).count()) + 1;
    return low + Nanoseconds{static_cast<std::int64_t>(random() % values)};
  };
  for (Participant& participant : participants) {
    participant.start = draw(schedule->start_min, schedule->start_max);
    participant.endpoints_done = std::max(
        participant.start, draw(schedule->endpoints_done_min, schedule->endpoints_done_max));
    if (schedule->open_before) {
      participant.open = std::max(Nanoseconds{0}, participant.start - *schedule->open_before);
    } else if (participant.open) {
      participant.open = std::min(*participant.open, participant.start);
    }
    if (participant.ready) participant.ready = std::max(*participant.ready, participant.start);
  }
}

std::uint32_t Deployment::host_count() const {
  std::set<HostId> hosts;
  for (const Participant& participant : participants) hosts.insert(participant.host);
  return static_cast<std::uint32_t>(hosts.size());
}

std::uint32_t Deployment::most_on_a_host() const {
  std::map<HostId, std::uint32_t> counts;
  std::uint32_t most = 0;
  for (const Participant& participant : participants) {
    most = std::max(most, ++counts[participant.host]);
  }
  return most;
}

}  // namespace stormproof::model
