// Runs cvc5 as a program of its own on an SMT-LIB 2 file. No shell takes part, and a solver that is
// absent, crashes, hangs or prints nonsense is an ordinary outcome: it just gives no answers.
#pragma once

#include <string>
#include <vector>

#include "checker/engines/smt/claims.hpp"

namespace stormproof::smt {

struct SolverRun {
  std::vector<Answer> answers;  ///< one for each `check-sat` that was answered, in order
  std::string failure;          ///< why there may be fewer answers than questions; empty: none
};

/// "cvc5 1.0.3", or empty if no cvc5 that runs is on PATH.
[[nodiscard]] std::string second_solver_name();

/// Asks cvc5 all `questions` of the file, each with the options' budget, time-out and seed.
[[nodiscard]] SolverRun ask_second_solver(const std::string& path, std::size_t questions,
                                          const Options& options);

}  // namespace stormproof::smt
