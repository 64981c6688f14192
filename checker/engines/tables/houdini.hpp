// Houdini: of many candidates, the largest set that is an invariant. Whoever states an invariant
// writes down what the proof is about; what else it needs, about which state goes with which, is
// found.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "checker/engines/tables/transition_system.hpp"

namespace stormproof::tables {

struct Kept {
  std::vector<bool> kept;            ///< by candidate
  std::vector<std::string> lost_at;  ///< the step that breaks it, or "initially"; empty if kept
  std::vector<std::string> lost_in;  ///< the state before that step: what is not false and not 0
};

/// The largest set of `candidates` that hold initially and that every step keeps together. About
/// the others that says nothing. Z3 alone looks for it: what is made of it is to be certified.
/// Nothing if a solver has no answer: what it has not looked at is no invariant, and `proof` says
/// why it has given up.
[[nodiscard]] std::optional<Kept> houdini(Proof& proof, const TransitionSystem& system,
                                          const Exprs& candidates);

/// Candidates that need no thought: counts are not negative, and a machine is in exactly one of its
/// states.
[[nodiscard]] Exprs facts_of(const TransitionSystem& system);

/// The largest set, which both solvers then check; nothing as above.
[[nodiscard]] std::optional<std::vector<bool>> inductive_together(Proof& proof,
                                                                  const TransitionSystem& system,
                                                                  const Exprs& candidates);

}  // namespace stormproof::tables
