// What the timers and the packet fields of a composition are in a slot of a frame.
#pragma once

#include <bit>
#include <concepts>
#include <cstdint>
#include <optional>
#include <type_traits>

#include "checker/engines/explorer/slot.hpp"
#include "fsm/composition/cyclone.hpp"
#include "fsm/composition/packets.hpp"
#include "fsm/stepper.hpp"
#include "model/engine/descriptor_set.hpp"
#include "model/engine/timer_kinds.hpp"

namespace stormproof::explorer {

namespace comp = fsm::composition;

/// Nothing: the timer belongs to what is not explored.
template <class Timer>
[[nodiscard]] constexpr std::optional<What> what_of() {
  for (auto k = static_cast<std::uint8_t>(What::heartbeat_expiry);
       k <= static_cast<std::uint8_t>(What::thread_run); ++k) {
    if (kind_of(What{k}, false) == model::event_kind_of<Timer>) return What{k};
  }
  return std::nullopt;
}

[[nodiscard]] inline std::uint16_t members_of(const model::DescriptorSet& set) {
  return static_cast<std::uint16_t>(set.word(0));
}

[[nodiscard]] constexpr std::uint8_t flag_of(comp::IsInitial) { return Slot::initial; }
[[nodiscard]] constexpr std::uint8_t flag_of(comp::IsRepair) { return Slot::from_repair; }
[[nodiscard]] constexpr std::uint8_t flag_of(comp::CarriesHeartbeat) {
  return Slot::carries_heartbeat;
}
[[nodiscard]] constexpr std::uint8_t flag_of(comp::cyclone::IsDirected) { return Slot::directed; }

/// The field holds for the first descriptors, up to some number, and is kept as that number.
template <class Field>
inline constexpr bool is_limit =
    std::is_same_v<Field, comp::Announces> || std::is_same_v<Field, comp::BelowBase>;

/// The descriptors for which the packet says it.
template <class Field>
[[nodiscard]] constexpr std::uint16_t members_said(const Slot& packet) {
  if constexpr (is_limit<Field>) return static_cast<std::uint16_t>(member(packet.number) - 1);
  return packet.set;
}

/// The packet says this, in the world of its relation.
template <class Saying, class World>
void say(Slot& packet, const Saying& saying, World& w) {
  using Field = typename Saying::Field;
  if constexpr (std::derived_from<Field, comp::PacketField>) {
    if (saying.value) packet.flags |= flag_of(Field{});
  } else if constexpr (std::derived_from<Field, comp::PacketNumber>) {
    packet.count = static_cast<std::uint16_t>(saying.value);
  } else if constexpr (is_limit<Field>) {
    packet.number = static_cast<std::uint8_t>(std::bit_width(members_of(w.set_of(saying.value))));
  } else {
    packet.set = members_of(w.set_of(saying.value));
  }
}

namespace detail {
/// The machines of a part.
template <class P>
class PartMachines {
 public:
  explicit PartMachines(std::span<const fsm::TableMutation> tables) : machines_{tables} {}
  template <class Event>
  auto step(fsm::StateId& state, const typename fsm::Stepper<typename P::Machine>::Input& input,
            std::uint32_t = 0) {
    return machines_.template step<Event>(state, input);
  }

 private:
  fsm::Stepper<typename P::Machine> machines_;
};
template <class Parts>
class Machines;
template <class... Ps>
class Machines<fsm::TypeList<Ps...>> : public PartMachines<Ps>... {
 public:
  explicit Machines(std::span<const fsm::TableMutation> tables) : PartMachines<Ps>{tables}... {}
};

}  // namespace detail

}  // namespace stormproof::explorer
