// The steps between the explored states, for what is decided about all paths together: which states
// cannot reach what they should, for which it is not known, and how much is sent on one path.
//
// A state is a zone, and a step of it may be open to some of its times only. So that *some* path
// leads from a state to a good one says too little: its other times may be stuck. What is known is
//   that nothing can be reached: no path without loss leads to a good state; or
//   that it will be: every path without loss leads there. At any of its times a state has a next
//   event, so if all events that can be the next one lead to states that will, so will this one.
// Where neither is known, the question is open.
#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <vector>

namespace stormproof::explorer {

class StateGraph {
 public:
  struct Edge {
    std::uint32_t from = 0;
    std::uint32_t to = 0;
    std::uint16_t generated = 0;  ///< descriptors that were put into DATA
    bool with_loss = false;
  };
  using Good = std::function<bool(std::uint32_t)>;

  void add(const Edge& edge) { edges_.push_back(edge); }

  /// All edges are there; states are numbered below `states`.
  void finish(std::uint32_t states);

  /// The first state from which no path without loss leads to a state that is good.
  [[nodiscard]] std::optional<std::uint32_t> first_that_cannot_reach(const Good& good) const;

  /// How many states have paths without loss of which it is not known that they lead to a good one.
  [[nodiscard]] std::uint32_t count_not_bound_to_reach(const Good& good) const;

  /// Most descriptors that are put into DATA along one path, or `limit + 1` if they are more.
  [[nodiscard]] std::uint32_t most_generated(std::uint32_t limit) const;

 private:
  /// Goes backwards from the good states over steps without loss; a state counts as reaching them
  /// as soon as `needed(state)` of its steps do. Which do.
  [[nodiscard]] std::vector<bool> backwards(
      const Good& good, const std::function<std::uint32_t(std::uint32_t)>& needed) const;

  std::uint32_t states_ = 0;
  std::vector<Edge> edges_;
  std::vector<std::uint32_t> incoming_;  // sources of the edges without loss, grouped by target
  std::vector<std::size_t> first_incoming_;
  std::vector<std::uint32_t> outgoing_;  // how many edges without loss start there
};

}  // namespace stormproof::explorer
