// A run stopped after one of its events: what the event did, by which rules, and in which states
// the machines of one participant are. A run has no way back, and needs none: it is made again up
// to the moment, which is the same each time.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "model/probe.hpp"
#include "model/scenario.hpp"

namespace stormproof::page {

/// A row of a machine's table fired in the event.
struct Step {
  std::string machine;
  std::string of;  ///< "relation 3→7, publications"
  std::string event, before, after;
  std::uint32_t descriptors = 0;  ///< that moved; 0 if the machine has none
  bool mine = false;              ///< a machine of the participant
};

/// How many descriptors of one stream are in which state towards one reader, in the order of the
/// machine's states.
struct ReaderStates {
  std::uint32_t reader = 0;
  model::Stream stream{};
  std::vector<std::uint32_t> counts;
};

/// A machine of the participant that has left its initial state, or returned to it.
struct MachineState {
  std::string machine, of, state;
};

struct Moment {
  std::uint64_t event = 0;  ///< its number, from 1; 0: nothing has happened yet
  model::Nanoseconds time;
  std::string what;                  ///< "HEARTBEAT expiry"
  std::vector<std::string> effects;  ///< ids: "AckNackArrives.3"
  std::vector<Step> steps;
  std::vector<std::string> packets;  ///< "DATA to 7, 12 descriptors", "HEARTBEAT from 3"
  std::string descriptor_machine;    ///< empty: no descriptor has moved, or they have none
  std::vector<ReaderStates> readers;
  std::vector<MachineState> machines;
  std::uint64_t missing = 0;
};

/// After the event of this number, or the last one if there are fewer.
[[nodiscard]] Moment moment_of(const model::Scenario& scenario, std::uint64_t event,
                               std::uint32_t participant);

/// The next event after this number in which a machine of the participant takes a step, or the last
/// one before it; nothing if there is none.
[[nodiscard]] std::optional<std::uint64_t> next_step_of(const model::Scenario& scenario,
                                                        std::uint64_t event,
                                                        std::uint32_t participant);
[[nodiscard]] std::optional<std::uint64_t> step_before_of(const model::Scenario& scenario,
                                                          std::uint64_t event,
                                                          std::uint32_t participant);

}  // namespace stormproof::page
