// Shrinking without RapidCheck: what is simpler than a scenario, for property tests and for whoever
// looks for the least scenario that still shows something, starting from a scenario of a user.
#pragma once

#include <functional>
#include <optional>
#include <vector>

#include "model/scenario.hpp"

namespace stormproof::props {

/// Scenarios that are one step simpler than `scenario`, boldest step first: smaller deployments,
/// knobs as in `base`, fewer packets with a fate of their own, shorter routes, and rounder numbers.
/// All of them are valid if `scenario` is and have a smaller `complexity` (complexity.hpp), so that
/// repeated steps come to an end. `limits` and `vary` stay as they are; a schedule goes once the
/// deployment changes.
[[nodiscard]] std::vector<model::Scenario> simpler_scenarios(const model::Scenario& scenario,
                                                             const model::Scenario& base);

/// The first of `simpler_scenarios` that `accepts` takes; the others are not even built.
[[nodiscard]] std::optional<model::Scenario> first_simpler(
    const model::Scenario& scenario, const model::Scenario& base,
    const std::function<bool(const model::Scenario&)>& accepts);

}  // namespace stormproof::props
