// From what several engines found about a property to one verdict. Nothing is dropped: each finding
// stays in the result, and what contradicts another makes the property disputed.
#pragma once

#include <vector>

#include "checker/verification/check/check.hpp"

namespace stormproof::checker {

/// Which finding decides: a dispute before all, then a violation, then the strongest that holds; of
/// equally strong ones that with the widest reach. At least one finding.
[[nodiscard]] std::size_t deciding_finding(const std::vector<props::Finding>& findings);

/// The verdict on the property. A counterexample that the simulator does not confirm makes its
/// finding disputed. So does a confirmed one the property, where another engine has proved that it
/// cannot be: the tables for whatever runs, the timelines for a run of the deployment in which no
/// packet takes longer than in the one that they measured.
[[nodiscard]] PropertyResult combined(const props::Property& property,
                                      std::vector<props::Finding> findings,
                                      const CheckRequest& request);

}  // namespace stormproof::checker
