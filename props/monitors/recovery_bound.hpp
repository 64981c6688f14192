// The bound of live.recovery: how long after the last failure everything is complete again under
// rules that recover.
#pragma once

#include "model/scenario.hpp"

namespace stormproof::props {

/// B, if the last failure is at `failed` and no packet takes longer than `delay`.
[[nodiscard]] model::Nanoseconds recovery_bound(const model::Scenario& scenario,
                                                model::Nanoseconds failed,
                                                model::Nanoseconds delay);

}  // namespace stormproof::props
