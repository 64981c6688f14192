// One pass over the nodes, with the participant of each host that has room for one more; and what
// such a participant says of its nodes.
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

Bytes last_graph_info(const Deployment& deployment) {
  constexpr std::int64_t gid_bytes = 24;
  constexpr std::int64_t of_the_participant = 2;  // its own writer and reader of the topic
  std::int64_t most = 0;
  for (const Participant& p : deployment.participants) {
    most = std::max(most, of_the_participant + Deployment::endpoints_of_a_node +
                              std::int64_t{p.publications} + p.subscriptions);
  }
  return Bytes{gid_bytes * most};
}

}  // namespace stormproof::model
