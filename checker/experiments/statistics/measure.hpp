// What is measured of a run: one list, with the names that files and options have and the words
// that people read. A study that compares fewer of them takes them from here.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

#include "model/message_class.hpp"

namespace stormproof::statistics {

enum class Measure : std::uint8_t {
  completion,
  messages,  ///< of all six classes
  initial_data,
  repair_data,
  heartbeat,
  acknack,
  spdp_multicast,
  spdp_unicast,
  user_control,   ///< messages of control-only relations, in no class
  lookup,         ///< questions and answers about types, in no class
  amplification,  ///< messages over those of the failure-free reference
  backlog,        ///< packets, highest of any participant
  // Of what happens to participants (`deployment.life`).
  recovery,         ///< from the end of the last outage, or from when somebody went
  lost_pairs,       ///< ordered pairs of which one forgot the other
  messages_before,  ///< of all six classes until the failure begins
  messages_during,  ///< until it is over
  messages_after    ///< from then on until all is recovered
};
inline constexpr std::size_t measure_count = 17;
/// Those that a run has whatever happens in it come first.
inline constexpr std::size_t common_measure_count = 12;
/// Those that a measured discovery has, too: completion, messages and the classes come first.
inline constexpr std::size_t discovery_measure_count = 2 + model::message_class_count;

[[nodiscard]] constexpr std::size_t index_of(Measure measure) {
  return static_cast<std::size_t>(measure);
}
[[nodiscard]] constexpr Measure measure_of(model::MessageClass one) {
  return static_cast<Measure>(2 + model::index_of(one));
}
static_assert(measure_of(model::MessageClass::spdp_unicast) == Measure::spdp_unicast);

/// "completion", "messages", "repair_data", …
[[nodiscard]] const char* name_of(Measure measure);
/// "completion", "repair DATA", "highest backlog", …
[[nodiscard]] const char* words_of(Measure measure);

}  // namespace stormproof::statistics
