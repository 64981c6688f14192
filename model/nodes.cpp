// One pass over the nodes, with the participant of each host that has room for one more.
#include "model/nodes.hpp"

#include <algorithm>
#include <map>

namespace stormproof::model {

namespace {

void join(Participant& process, const Participant& node) {
  process.publications += node.publications + Deployment::publications_of_a_node;
  process.subscriptions += node.subscriptions + Deployment::subscriptions_of_a_node;
  process.start = std::min(process.start, node.start);
  process.endpoints_done = std::max(process.endpoints_done, node.endpoints_done);
  if (process.open) {
    process.open = std::min({*process.open, node.open.value_or(node.start), process.start});
  }
  if (process.ready) {
    process.ready = std::max({*process.ready, node.ready.value_or(node.start), process.start});
  }
}

}  // namespace

Deployment sharing_participants(const Deployment& nodes, std::uint32_t per_participant) {
  struct Open {
    std::size_t at = 0;  ///< among the participants
    std::uint32_t nodes = 0;
  };
  Deployment shared = nodes;
  shared.participants.clear();
  std::map<HostId, Open> of_host;
  for (const Participant& node : nodes.participants) {
    Open& open = of_host[node.host];
    if (open.nodes > 0 && open.nodes < per_participant) {
      join(shared.participants[open.at], node);
      ++open.nodes;
    } else {
      open = {shared.participants.size(), 1};
      shared.participants.push_back(node);
    }
  }
  return shared;
}

}  // namespace stormproof::model
