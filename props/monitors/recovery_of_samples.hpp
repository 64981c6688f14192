// live.recovery where participants write samples about what they have: Cyclone DDS.
#pragma once

#include <optional>

#include "props/monitors/monitors.hpp"

namespace stormproof::props {

/// From the last failure on everybody agrees with everybody else within the bound: who is there
/// knows exactly what the others have, and nobody who is gone.
[[nodiscard]] MonitorPtr watch_recovery_of_samples(const model::Scenario& scenario,
                                                   std::optional<model::Nanoseconds> bound);

}  // namespace stormproof::props
