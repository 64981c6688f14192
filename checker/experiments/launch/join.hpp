// What one more robot costs a fleet that runs.
#pragma once

#include "checker/experiments/launch/launch.hpp"

namespace stormproof::launch {

/// Runs the fleet of the scenario, started at once, with a robot that joins, and again without it
/// for as long.
[[nodiscard]] Join join(trials::Runner& runner, const model::Scenario& scenario,
                        const Request& request);

}  // namespace stormproof::launch
