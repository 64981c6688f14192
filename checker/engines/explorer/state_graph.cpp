// Backward reachability, and the longest path.
#include "checker/engines/explorer/state_graph.hpp"

#include <algorithm>

namespace stormproof::explorer {

void StateGraph::finish(std::uint32_t states) {
  states_ = states;
  first_incoming_.assign(states + 1, 0);
  outgoing_.assign(states, 0);
  for (const Edge& edge : edges_) {
    if (edge.with_loss) continue;
    ++first_incoming_[edge.to + 1];
    ++outgoing_[edge.from];
  }
  for (std::uint32_t k = 0; k < states; ++k) first_incoming_[k + 1] += first_incoming_[k];
  incoming_.resize(first_incoming_.back());
  std::vector<std::size_t> next(first_incoming_.begin(), first_incoming_.end() - 1);
  for (const Edge& edge : edges_) {
    if (!edge.with_loss) incoming_[next[edge.to]++] = edge.from;
  }
}

std::vector<bool> StateGraph::backwards(
    const Good& good, const std::function<std::uint32_t(std::uint32_t)>& needed) const {
  std::vector<bool> reaches(states_, false);
  std::vector<std::uint32_t> found(states_, 0);
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
      const std::uint32_t source = incoming_[e];
      if (++found[source] < needed(source) || reaches[source]) continue;
      reaches[source] = true;
      work.push_back(source);
    }
  }
  return reaches;
}

std::optional<std::uint32_t> StateGraph::first_that_cannot_reach(const Good& good) const {
  const std::vector<bool> reaches = backwards(good, [](std::uint32_t) { return 1U; });
  const auto first = std::find(reaches.begin(), reaches.end(), false);
  if (first == reaches.end()) return std::nullopt;
  return static_cast<std::uint32_t>(first - reaches.begin());
}

std::uint32_t StateGraph::count_not_bound_to_reach(const Good& good) const {
  const std::vector<bool> reaches =
      backwards(good, [&](std::uint32_t state) { return outgoing_[state]; });
  return static_cast<std::uint32_t>(std::count(reaches.begin(), reaches.end(), false));
}

std::uint32_t StateGraph::most_generated(std::uint32_t limit) const {
  std::vector<std::uint32_t> most(states_, 0);
  std::uint32_t overall = 0;
  for (bool changed = true; changed && overall <= limit;) {
    changed = false;
    for (const Edge& edge : edges_) {
      const std::uint32_t here = std::min(limit + 1, most[edge.from] + edge.generated);
      if (here <= most[edge.to]) continue;
      most[edge.to] = here;
      overall = std::max(overall, here);
      changed = true;
    }
  }
  return overall;
}

}  // namespace stormproof::explorer
