// Finds steps in which effects happen. From the states that are known to be reached, the solver
// looks for one more step with something new: an effect that has not happened yet, or a variable
// with a value that it has not had. The state after it is evaluated, and is reached, too; and so
// on, until there is nothing new within three steps. Each effect that is found has its steps, which
// anybody can follow; what is not found may still be possible.
#pragma once

#include <chrono>
#include <cstddef>
#include <string>
#include <vector>

#include "checker/engines/tables/transition_system.hpp"

namespace stormproof::tables {

struct WitnessStep {
  std::size_t from = 0;  ///< the step, counted from 1, after which it happens; 0: in the beginning
  std::string name;
  std::string inputs;              ///< those that are set
  std::vector<std::size_t> marks;  ///< variables that it makes true for the first time
};

struct Witnesses {
  std::vector<WitnessStep> steps;
  std::vector<bool> found;  ///< by mark
  std::string gap;  ///< why the search ended before there was nothing new; empty: it did not
};

/// The variables for which `is_mark` are marks: false at first, and read by nothing.
[[nodiscard]] Witnesses find_witnesses(const TransitionSystem& system,
                                       const std::vector<bool>& is_mark,
                                       const smt::Options& options);

}  // namespace stormproof::tables
