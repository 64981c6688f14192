// How the reasons of violations name things: participants, writers, relations, descriptors, times.
#pragma once

#include <cstdint>
#include <string>

#include "model/engine/topology.hpp"
#include "model/units.hpp"

namespace stormproof::props {

/// Exact, in the largest unit that leaves a whole part: "16.136228 ms", "2 s", "0 ns".
[[nodiscard]] std::string time_text(model::Nanoseconds time);

/// "participant 0's pub writer"; writers are 2 · participant + stream.
[[nodiscard]] std::string writer_text(std::uint32_t writer);

/// "participant 0's pub stream at participant 3".
[[nodiscard]] std::string relation_text(const model::Topology& topology, std::uint32_t relation);

/// "descriptor 4 of participant 0's pub stream at participant 3".
[[nodiscard]] std::string descriptor_text(const model::Topology& topology, std::uint32_t relation,
                                          std::uint32_t descriptor);

/// 2 · participant + stream of the relation's writer.
[[nodiscard]] inline std::uint32_t writer_of(const model::Topology& topology,
                                             std::uint32_t relation) {
  return 2 * topology.pair(relation / 2).source + relation % 2;
}

}  // namespace stormproof::props
