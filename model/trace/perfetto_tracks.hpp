// The rows of the timeline: one group for the network with a row per channel, one group per
// participant with a row for what it does as a whole (announcements, creation of endpoints), one
// for each of its built-in SEDP writers and readers, and one for its user topics.
#pragma once

#include <optional>

#include "model/engine/packet.hpp"
#include "model/probe.hpp"
#include "model/scenario.hpp"
#include "model/trace/perfetto_events.hpp"

namespace stormproof::model::trace {

inline constexpr std::uint32_t network_process = 1;

[[nodiscard]] constexpr std::uint32_t participant_process(std::uint32_t i) { return 2 + i; }

[[nodiscard]] Track channel_track(std::uint32_t channel);
[[nodiscard]] Track participant_track(std::uint32_t participant);
[[nodiscard]] Track writer_track(std::uint32_t participant, Stream stream);
[[nodiscard]] Track reader_track(std::uint32_t participant, Stream stream);
[[nodiscard]] Track user_track(std::uint32_t participant);

/// The row from which participant `source` sends the packet.
[[nodiscard]] Track sender_track(const Packet& packet, std::uint32_t source);
/// The row at which participant `destination` takes the packet.
[[nodiscard]] Track receiver_track(const Packet& packet, std::uint32_t destination);
/// The row on which the machine's transitions are shown. Those of channels and timers show as
/// slices and arrows already, those of control-only relations belong to two participants.
[[nodiscard]] std::optional<Track> machine_track(const MachineRef& machine,
                                                 const Topology& topology);
/// Whether the event is a timer that has a row.
[[nodiscard]] bool is_timer(EventKind kind);
/// The row of a timer.
[[nodiscard]] Track timer_track(EventKind kind, std::uint32_t subject, const Topology& topology);

/// Names all rows.
void name_tracks(PerfettoEvents& events, const Scenario& scenario);

}  // namespace stormproof::model::trace
