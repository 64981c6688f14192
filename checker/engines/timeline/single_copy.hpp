// storm.single-copy as a theorem: when two HEARTBEATs lead to a needless repair although every
// packet takes the same time.
#pragma once

#include "checker/engines/timeline/theorem.hpp"

namespace stormproof::timeline {

/// By how many nanoseconds the borders of the claimed condition are off: not at all, except to show
/// that they cannot be.
struct BorderShift {
  int lower = 0;
  int upper = 0;
};

/// Decides: with constant delay Δ, source delay λ and two HEARTBEATs g apart, the first of which
/// finds a descriptor missing, the second leads to another repair iff λ + τ_N + τ_S < g < 2Δ + τ_N;
/// with Fast DDS's writer (λ = 0) iff also g > τ_A. And that pushed DATA is never repaired because
/// of a HEARTBEAT.
void prove_single_copy(Theorem& theorem, const BorderShift& shift = {});

}  // namespace stormproof::timeline
