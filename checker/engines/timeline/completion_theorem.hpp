// live.completion as a theorem: the conditions of the proof in specs/guide/bounds.md, for all
// values of all parameters. The bound itself is in checker/engines/bounds/completion_bound.hpp.
#pragma once

#include "checker/engines/timeline/theorem.hpp"

namespace stormproof::timeline {

/// By how many nanoseconds the parts of the bound are claimed to be smaller than they are: none,
/// except to show that they cannot be.
struct Tightening {
  int exchange = 0;  ///< F
  int window = 0;    ///< W
  int opening = 0;   ///< what the first loss costs
};

/// Decides the conditions for the paper's writer.
void prove_completion(Theorem& theorem, const Tightening& tighter = {});
/// Decides the conditions for Fast DDS's writer.
void prove_completion_fastdds(Theorem& theorem, const Tightening& tighter = {});

}  // namespace stormproof::timeline
