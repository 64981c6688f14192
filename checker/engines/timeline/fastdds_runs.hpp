// Fast DDS's machines against their completion bound.
#pragma once

#include "checker/engines/timeline/findings.hpp"

namespace stormproof::timeline {

/// Runs schedules with losses, pulled and pushed, under the request's mutant if it has one. A run
/// that is later than the bound makes the finding violated; otherwise a line says how many keep it.
void hold_fastdds_against_bound(const Question& question, props::Finding& finding);

}  // namespace stormproof::timeline
