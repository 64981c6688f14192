// The search for a short counterexample in smaller deployments.
#pragma once

#include <functional>
#include <string_view>

#include "model/scenario.hpp"
#include "props/verdict.hpp"

namespace stormproof::exact {

/// `found` violates its property on `scenario` (or on it with a drawn schedule). Returns the
/// counterexample with the fewest events among those that smaller deployments under the same
/// profiles yield, or `found` if none has fewer. Looks at some million
/// events at most.
[[nodiscard]] props::Counterexample shortest(const props::Counterexample& found,
                                             const model::Scenario& scenario,
                                             std::string_view property,
                                             const std::function<bool()>& goes_on);

}  // namespace stormproof::exact
