// Unbounded safety: a transition system whose steps come from the tables, and the question whether
// a bad state can be reached in any number of steps. Spacer (Z3's fixed-point engine) looks for an
// invariant; what it finds is not believed but checked again with three kinds of plain conditions,
// by both solvers: it holds initially, every step keeps it, and it excludes the bad states. If
// there is no invariant, or Spacer finds none within its budget, the shortest sequence of steps is
// looked for by unrolling.
#pragma once

#include <string>
#include <vector>

#include "checker/engines/tables/proof.hpp"

namespace stormproof::tables {

/// How the names of inputs begin that traces do not show.
inline constexpr char hidden_input = '?';

struct SystemStep {
  std::string name;
  Exprs inputs;  ///< unknowns that are drawn anew at each step
  Expr guard;    ///< over variables and inputs: the step is possible
  Exprs next;    ///< the new value of each variable, in their order
};

struct TransitionSystem {
  Exprs variables;  ///< their names are what invariants and traces show
  Expr initial;
  std::vector<SystemStep> steps;
  Expr bad;
};

/// Whether `bad` can be reached, and how that is known.
struct Reached {
  smt::Answer answer = smt::Answer::unknown;
  std::vector<std::string> lines;  ///< the invariant of `unsat`, the steps of `sat`
  std::string why;                 ///< of `unknown`
};
[[nodiscard]] Reached reach_bad(Proof& proof, const TransitionSystem& system);

/// The plain conditions that make `invariant` a proof that `bad` cannot be reached. Whether all of
/// them hold; one that is refuted contradicts whoever found the invariant, and makes a dispute.
[[nodiscard]] bool certify(Proof& proof, const TransitionSystem& system, const Expr& invariant);

/// Decides whether `bad` can be reached. Proved: the invariant goes into the details. Violated: the
/// shortest sequence of steps does, headed by `breaks`. Returns the method, for `Proof::finish`.
std::string prove_unreachable(Proof& proof, const TransitionSystem& system,
                              const std::string& breaks);

/// `expr` with each variable replaced by its value.
[[nodiscard]] Expr with(const Expr& expr, const Exprs& variables, const Exprs& values);
/// An invariant as lines of text: one clause each, in the form "a and b imply c or d".
[[nodiscard]] std::vector<std::string> invariant_lines(const Expr& invariant);

}  // namespace stormproof::tables
