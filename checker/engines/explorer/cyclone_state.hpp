// The state of an explored relation of Cyclone DDS: what its rules have, but for times, which are
// marks of a frame, and what its event threads have not sent yet. Counts of HEARTBEATs and ACKNACKs
// only matter in comparison with each other, and are kept as small as that allows.
#pragma once

#include <array>
#include <cstdint>

#include "checker/engines/explorer/cyclone_store.hpp"
#include "checker/engines/explorer/slot.hpp"
#include "fsm/composition/cyclone.hpp"

namespace stormproof::explorer {

namespace cyclone_parts {
/// The thread of the reader's participant; the composition's is that of the writer's.
struct ReaderThread : comp::Part<fsm::EventThread, comp::owner::relation> {};
/// The time that the timer was due at is over, and it has not come: only a mistake does that.
struct AckTimeMissed : comp::Flag<comp::owner::relation> {};
struct HeartbeatTimeMissed : comp::Flag<comp::owner::relation> {};

/// Samples that can be explored: all of them, and what other writers say at the same time, fit into
/// one packet, so that the others do not change what is explored.
inline constexpr unsigned most_samples = 2;
/// Messages that can wait at once.
inline constexpr unsigned most_queued = 6;

using Things =
    comp::Joined<comp::cyclone::Cyclone::Parts, comp::cyclone::Cyclone::State,
                 fsm::TypeList<ReaderThread, AckTimeMissed, HeartbeatTimeMissed, Asked, Generated>>;
}  // namespace cyclone_parts

/// The mark of a frame that a time of the rules is.
template <class V>
inline constexpr What mark_of = What::data;  // none
template <>
inline constexpr What mark_of<comp::cyclone::LastHeartbeat> = What::last_heartbeat;
template <>
inline constexpr What mark_of<comp::cyclone::HeartbeatCountsUntil> = What::heartbeat_counts_until;
template <>
inline constexpr What mark_of<comp::cyclone::AckCountsUntil> = What::acknack_counts_until;
template <>
inline constexpr What mark_of<comp::cyclone::QuietUntil> = What::quiet_until;
template <>
inline constexpr What mark_of<comp::cyclone::HushUntil> = What::hush_until;
template <>
inline constexpr What mark_of<comp::cyclone::AgainAt> = What::again_at;
template <class V>
concept Time = is_mark(mark_of<V>);

struct CycloneState : ComposedState<cyclone_parts::Things, cyclone_parts::most_samples> {
  std::array<Slot, cyclone_parts::most_queued> queue{};  ///< of the writer's participant
  Slot kept{};                                           ///< the answer that waits, if one does
  std::array<std::uint8_t, 2> listed{};  ///< by participant: how often its timer is on the list
  std::uint8_t queued = 0;
  std::uint8_t keeps = 0;
  std::uint32_t unused = 0;  ///< no padding

  bool operator==(const CycloneState& other) const {
    return ComposedState::operator==(other) && queue == other.queue && kept == other.kept &&
           listed == other.listed && queued == other.queued && keeps == other.keeps;
  }
};

}  // namespace stormproof::explorer
