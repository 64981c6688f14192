// How far the explorer looks: the small world in which it tries every interleaving. The scope is
// part of every verdict, because a claim about a small world is no more than that.
#pragma once

#include <cstdint>
#include <string>

#include "model/units.hpp"

namespace stormproof::explorer {

/// Readers of one writer that can be explored together.
inline constexpr unsigned most_readers = 3;
/// Writers of one participant that can: one for its publications, one for its subscriptions.
inline constexpr unsigned most_writers = 2;
/// Descriptors of a writer whose implementation does not say how many there are.
inline constexpr unsigned most_descriptors = 8;

/// Samples of a writer of Cyclone DDS: all of them, and what other writers say at the same time,
/// fit into one packet, so that the others do not change what is explored.
inline constexpr unsigned most_samples = 2;

struct Scope {
  /// D of each writer, 1 … most_descriptors; with Fast DDS the 9 default publications, and the 8
  /// default subscriptions; with Cyclone DDS the first publication, or the first two.
  unsigned descriptors = 1;
  unsigned losses = 0;               ///< k, at most this many packets are lost
  model::Nanoseconds least_delay;    ///< of a packet, from generation to reception
  model::Nanoseconds largest_delay;  ///< Δ
  model::Nanoseconds
      leaves_within;    ///< Δ_s: repair DATA leave the source at most this long after generation
  bool fifo = false;    ///< packets of one source arrive in the order of their generation
  unsigned pushed = 0;  ///< not the paper's: this many descriptors are created after the match
  bool side_by_side = false;  ///< the two sides of a relation open apart, at most Δ
  unsigned readers = 1;       ///< of each writer, 1 … most_readers
  unsigned writers = 1;       ///< of the one participant, 1 … most_writers
  /// With several readers: the last one joins at most this long after the others, which learn of
  /// the writer together. Not with `side_by_side`.
  model::Nanoseconds joins_within;
  /// The piggyback budget is part of the state; otherwise it is never used up.
  bool counts_bytes = true;
};

/// "D = 2, delays in [0 ms, 250 ms], at most 1 loss, any interleaving".
[[nodiscard]] std::string to_text(const Scope& scope);
/// A relation among several: "reader 1", "sub writer".
[[nodiscard]] std::string relation_text(const Scope& scope, unsigned relation);
/// What tells the scopes of one scenario apart: "D = 2, k = 1".
[[nodiscard]] std::string short_text(const Scope& scope);

}  // namespace stormproof::explorer
