// Backward reachability.
#include "checker/engines/explorer/state_graph.hpp"

namespace stormproof::explorer {

void StateGraph::finish(std::uint32_t states) {
  states_ = states;
  first_incoming_.assign(states + 1, 0);
  for (const Edge& edge : edges_) ++first_incoming_[edge.to + 1];
  for (std::uint32_t k = 0; k < states; ++k) first_incoming_[k + 1] += first_incoming_[k];
  incoming_.resize(edges_.size());
  std::vector<std::size_t> next(first_incoming_.begin(), first_incoming_.end() - 1);
  for (const Edge& edge : edges_) incoming_[next[edge.to]++] = edge.from;
}

std::optional<std::uint32_t> StateGraph::first_that_cannot_reach(
    const std::function<bool(std::uint32_t)>& good) const {
  std::vector<bool> reaches(states_, false);
  std::vector<std::uint32_t> work;
  for (std::uint32_t k = 0; k < states_; ++k) {
    if (!good(k)) continue;
    reaches[k] = true;
    work.push_back(k);
  }
  while (!work.empty()) {
    const std::uint32_t target = work.back();
    work.pop_back();
    for (std::size_t e = first_incoming_[target]; e < first_incoming_[target + 1]; ++e) {
      if (reaches[incoming_[e]]) continue;
      reaches[incoming_[e]] = true;
      work.push_back(incoming_[e]);
    }
  }
  for (std::uint32_t k = 0; k < states_; ++k) {
    if (!reaches[k]) return k;
  }
  return std::nullopt;
}

}  // namespace stormproof::explorer
