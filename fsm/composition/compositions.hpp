// The list of all compositions, as data.
#pragma once

#include <vector>

#include "fsm/composition/composition_info.hpp"

namespace stormproof::fsm::composition {

/// The paper's and Fast DDS's, which includes the control-only relations.
[[nodiscard]] std::vector<CompositionInfo> compositions();

}  // namespace stormproof::fsm::composition
