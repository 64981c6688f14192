// What the timers, the packets and their fields of a program are in a slot of a frame, and which
// rule its event has.
#pragma once

#include <cstdint>
#include <optional>
#include <string_view>

#include "checker/engines/explorer/specialised.hpp"
#include "fsm/program/program.hpp"

namespace stormproof::explorer {

[[nodiscard]] inline bool is_of_descriptors(const fsm::program::Thing& thing) {
  return (thing.owner.indices & fsm::composition::owner::descriptor_index) != 0;
}
/// Nothing: the timer belongs to what is not explored.
[[nodiscard]] std::optional<What> what_of(const fsm::program::Thing& timer);
/// Nothing: it is none of those that readers and writers exchange.
[[nodiscard]] std::optional<What> what_of_packet(const fsm::program::Program& program,
                                                 fsm::program::Tag packet);

/// The rule of an event; null if there is none.
[[nodiscard]] const fsm::program::Rule* rule_of(const fsm::program::Program& program, What event);

/// How a slot says what a packet says of a field.
struct SlotField {
  std::string_view name;
  Specialised::From as{};
  std::uint8_t flag = 0;
};
[[nodiscard]] const SlotField& slot_field(const fsm::program::Thing& field);

/// The descriptors for which the packet says it, as a set or as the number of the first ones.
[[nodiscard]] inline std::uint16_t members_said(Specialised::From as, const Slot& packet) {
  const bool is_limit = as == Specialised::From::limit;
  return is_limit ? static_cast<std::uint16_t>(member(packet.number) - 1) : packet.set;
}

}  // namespace stormproof::explorer
