// The list of all compositions, as data.
#pragma once

#include <map>
#include <string>
#include <vector>

#include "fsm/composition/composition_info.hpp"

namespace stormproof::fsm::composition {

/// The paper's, then Fast DDS's, which includes the control-only relations.
[[nodiscard]] const std::vector<CompositionInfo>& compositions();

/// The ids of the effects of the rules and procedures of a composition.
[[nodiscard]] std::map<EffectKey, std::string> effect_ids(const CompositionInfo& composition);

}  // namespace stormproof::fsm::composition
