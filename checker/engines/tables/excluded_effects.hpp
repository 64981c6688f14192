// Effects that a knob of the profile excludes by itself: they are inside a condition of their rule
// that is false whatever happens, because of what the rule asks of the profile there. Unlike what
// ruled_out.hpp proves of the derived system this follows from the recorded program alone, so it
// can be said of every composition.
#pragma once

#include <vector>

#include "checker/engines/tables/impossible_effects.hpp"
#include "model/dds_profile.hpp"

namespace stormproof::tables {

/// Each effect is in the group of the first key that excludes it, in the order of the page.
[[nodiscard]] std::vector<ImpossibleEffects> excluded_effects(const model::DdsProfile& dds);
/// Those that a deployment with one server excludes besides: what servers say to each other.
[[nodiscard]] ImpossibleEffects effects_between_servers(const model::DdsProfile& dds);

}  // namespace stormproof::tables
