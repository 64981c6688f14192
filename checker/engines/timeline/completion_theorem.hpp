// live.completion as a theorem: the conditions of the proof in specs/guide/bounds.md for the
// paper's writer, for all values of all parameters. The bound itself is in
// checker/engines/bounds/completion_bound.hpp. What is proved of both writers from their rules is
// in checker/engines/tables/completion_certificate.hpp.
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

/// Decides the conditions.
void prove_completion(Theorem& theorem, const Tightening& tighter = {});

}  // namespace stormproof::timeline
