// Which types participants have that others do not, as far as a capture shows it: a Fast DDS 3
// participant asks for a type that it does not know before it matches an endpoint. Who asks, once
// for each type and stream, sends two questions, and is sent two answers; each of these goes to all
// participants (specs/guide/fastdds.md, rules L).
#pragma once

#include <cstddef>
#include <cstdint>

#include "checker/evidence/capture/topology.hpp"

namespace stormproof::capture {

struct UnknownTypes {
  /// Whether endpoints announce what types can be looked up by (TypeInformation).
  bool can_be_looked_up = false;
  /// Types that a participant has and no other one, of the participant with the most.
  std::size_t most_of_a_participant = 0;
  /// DATA of questions and answers across hosts, to each receiver, if everybody knows everybody
  /// before anybody asks.
  std::uint64_t lookups = 0;
  /// So many types that nobody else has give as many lookups, if each participant has them.
  std::uint32_t per_participant = 0;
};

[[nodiscard]] UnknownTypes unknown_types(const Topology& topology);

}  // namespace stormproof::capture
