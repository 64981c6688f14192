// The steps without loss between the explored states, for the claim about what can still happen:
// which states cannot reach what they should.
#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <vector>

namespace stormproof::explorer {

class StateGraph {
 public:
  void add_edge(std::uint32_t from, std::uint32_t to) { edges_.push_back({from, to}); }

  /// All edges are there; states are numbered below `states`.
  void finish(std::uint32_t states);

  /// The first state from which no path leads to a state that is good.
  [[nodiscard]] std::optional<std::uint32_t> first_that_cannot_reach(
      const std::function<bool(std::uint32_t)>& good) const;

 private:
  struct Edge {
    std::uint32_t from = 0;
    std::uint32_t to = 0;
  };

  std::uint32_t states_ = 0;
  std::vector<Edge> edges_;              // ascending by `from`
  std::vector<std::uint32_t> incoming_;  // sources of the edges, grouped by target
  std::vector<std::size_t> first_incoming_;
};

}  // namespace stormproof::explorer
