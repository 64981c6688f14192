// live.quiescence as a theorem: when the last SEDP packet is sent once everything is received and
// nothing is lost any more. The bound itself is props::quiescence_bound.
#pragma once

#include "checker/engines/timeline/directed_run.hpp"
#include "checker/engines/timeline/theorem.hpp"

namespace stormproof::timeline {

/// Decides the conditions of the proof in specs/guide/bounds.md, for the paper's writer with the
/// periodic policy and a single timer. `tighter`: the bound is claimed to be smaller by this many
/// nanoseconds, to show that it cannot be.
void prove_quiescence(Theorem& theorem, int tighter = 0);

/// A schedule whose last packet is sent exactly (1 + m)·τ_H + Δ + τ_A after its last loss. Needs
/// τ_H > Δ + τ_A and no initial ACKNACK before Δ.
[[nodiscard]] Director last_packet_late(model::Nanoseconds delta);

/// A schedule in which the reader's initial ACKNACKs never end: all HEARTBEATs are lost, an initial
/// ACKNACK confirms everything, and the writer falls silent. DATA takes `data`, which must not be
/// more than τ_I.
[[nodiscard]] Director all_heartbeats_lost(model::Nanoseconds data);

}  // namespace stormproof::timeline
