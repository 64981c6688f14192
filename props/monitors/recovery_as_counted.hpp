// live.recovery where the run itself counts what participants do not agree on: Cyclone DDS, and
// Fast DDS with Discovery Servers.
#pragma once

#include <optional>

#include "props/monitors/monitors.hpp"

namespace stormproof::props {

/// From the last failure on everybody agrees with everybody else within the bound: who is there
/// knows what the others have, or with a server what it matches of that, and nobody who is gone.
[[nodiscard]] MonitorPtr watch_recovery_as_counted(const model::Scenario& scenario,
                                                   std::optional<model::Nanoseconds> bound);

}  // namespace stormproof::props
