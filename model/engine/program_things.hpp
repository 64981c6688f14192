// What knobs of a recorded program (fsm/program) are in a profile, and what its timers are in the
// event queue: for those who read programs what composition_knobs.hpp and timer_kinds.hpp are for
// those who execute rules.
#pragma once

#include <cstdint>
#include <optional>

#include "fsm/program/program.hpp"
#include "model/dds_profile.hpp"
#include "model/event.hpp"

namespace stormproof::model {

/// A switch, 0 or 1, or a delay in ns; nothing: it is not the profile's, but the deployment's.
[[nodiscard]] std::optional<std::int64_t> knob_value(const fsm::program::Thing& knob,
                                                     const DdsProfile& dds);

/// The kind of the events that a timer is. Of a timer that no shipped composition has:
/// EventKind::dispatch.
[[nodiscard]] EventKind event_kind(const fsm::program::Thing& timer);

}  // namespace stormproof::model
