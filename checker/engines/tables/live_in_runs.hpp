// composition.live of rules for whose effects the solvers find no steps within their budget.
#pragma once

#include "checker/engines/tables/properties.hpp"

namespace stormproof::tables {

/// Looks for the effects in runs of the simulator. Proved if each happens with the knobs of the
/// profile; sampled if some happen with other knobs only.
[[nodiscard]] Finding live_in_runs(const checker::CheckRequest& request);

}  // namespace stormproof::tables
