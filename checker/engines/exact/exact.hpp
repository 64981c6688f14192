// The engine "exact run". A scenario has one trajectory, so running it decides every property that
// can be observed, for that trajectory. A scenario whose schedule is drawn has one for each seed;
// then the answer is a sample.
#pragma once

#include <span>
#include <string_view>

#include "checker/engines/bounds/check_request.hpp"

namespace stormproof::exact {

/// The findings about those of `properties` that have a monitor. With a mutant, its rules and knobs
/// run, and the monitors hold them against `request.scenario`. Without one, a violation is looked
/// for in smaller deployments, too, and the shortest is the counterexample.
[[nodiscard]] checker::Findings check(std::span<const std::string_view> properties,
                                      const checker::CheckRequest& request);

}  // namespace stormproof::exact
