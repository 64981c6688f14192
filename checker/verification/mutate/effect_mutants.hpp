// The mutants of what happens between the machines: one for every mistake that can be made at an
// effect, condition or loop of a composition (fsm/composition/effect_mutation.hpp).
#pragma once

#include <vector>

#include "checker/verification/mutate/mutants.hpp"

namespace stormproof::mutate {

/// Ids are `composition:effect:change`, "paper:AckNackArrives.4:dropped"; of a condition or loop
/// the effect is the first one in it, with its depth, "paper:AckNackArrives.5:if2:always".
[[nodiscard]] std::vector<CatalogueEntry> effect_mutants();

}  // namespace stormproof::mutate
