// The simulator as what the search asks: one run of a scenario, with monitors of the properties and
// limits that a setting must keep.
#pragma once

#include <functional>
#include <span>

#include "checker/experiments/tune/outcome.hpp"
#include "model/scenario.hpp"

namespace stormproof::tune {

/// One run until completion, or `limit`, whichever comes first. `ids` are properties and limits
/// that have a monitor. Nothing if `goes_on`, asked now and then, said no.
[[nodiscard]] std::optional<Outcome> run_once(const model::Scenario& scenario,
                                              std::span<const std::string_view> ids,
                                              model::Nanoseconds limit,
                                              const std::function<bool()>& goes_on);

/// Ids that every setting can be held against in ordinary runs: properties of the catalogue, and
/// the limits of the scenario.
[[nodiscard]] std::vector<std::string_view> watchable(const model::Scenario& scenario);

}  // namespace stormproof::tune
