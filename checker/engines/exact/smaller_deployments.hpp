// Deployments that are smaller than a given one, smallest first: where to look for a counterexample
// that a person can read.
#pragma once

#include <vector>

#include "model/scenario.hpp"

namespace stormproof::exact {

/// Scenarios with the profiles of `scenario` and fewer hosts, participants or endpoints:
/// homogeneous ones, in which everybody starts at once (or at the lower bounds of the schedule),
/// then parts of the deployment as it is. None of them has a schedule to draw.
[[nodiscard]] std::vector<model::Scenario> smaller_scenarios(const model::Scenario& scenario);

}  // namespace stormproof::exact
