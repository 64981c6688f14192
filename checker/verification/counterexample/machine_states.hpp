// What state the machines are in after an event of a counterexample. A story tells what changes;
// who steps through it wants to see what holds, too: for the relations that the violation concerns,
// the reader's and the writer's machines, the state of every descriptor, and what the reader has.
#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "props/verdict.hpp"

namespace stormproof::counterexample {

struct StateRow {
  std::string owner;                ///< "relation 0→1 pub", "pub writer of participant 0"
  std::string machine;              ///< "DiscoveryReader"; "received" for what the reader has
  std::string text;                 ///< "Complete"; "U 0–3, R 4"
  std::vector<std::string> states;  ///< names in `text`; empty for what the reader has
  bool moved = false;               ///< it changed since the event before in the list
};

/// The states after each of these events (numbers, ascending), machine by machine. Machines that
/// have not moved up to the last of them are left out. At most `relations` relations are told.
[[nodiscard]] std::vector<std::vector<StateRow>> states_after(
    const props::Counterexample& counterexample, std::span<const std::uint64_t> events,
    std::size_t relations = 3);

}  // namespace stormproof::counterexample
