// Which events of a run explain why a property breaks in the last one: those that led to it
// (backward over causes and packets), and all that happened on the relation that it concerns. A
// storm has thousands of events, and a person can read forty.
#pragma once

#include <cstdint>
#include <set>
#include <vector>

#include "checker/verification/counterexample/history.hpp"

namespace stormproof::counterexample {

struct Relevance {
  std::set<std::uint32_t> relations;  ///< that the violating event concerns
  std::vector<bool> steps;            ///< by event
  /// By event: it belongs to the shortest chain of causes, changes a state on the relations, or
  /// moves DATA there. If there is no room for everything, the others go first.
  std::vector<bool> essential;
  std::set<std::uint64_t> packets;  ///< numbers
  std::size_t count = 0;            ///< of relevant steps

  [[nodiscard]] bool concerns(std::uint32_t relation) const { return relations.contains(relation); }
};

[[nodiscard]] Relevance relevance_of(const History& history);

/// Participant whose state a transition changes: the reader or the writer of its relation, the
/// participant itself; `to_everybody` for channels and control-only relations.
[[nodiscard]] std::uint32_t owner_of(const model::trace::TransitionList::Entry& transition,
                                     const Step& step, const History& history);

}  // namespace stormproof::counterexample
