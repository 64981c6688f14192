// The list of all machines, as data: for diagrams, proofs and tests that treat every machine alike.
#pragma once

#include <vector>

#include "fsm/reflect.hpp"

namespace stormproof::fsm {

/// Every machine of the paper's model, in the order in which documents show them.
[[nodiscard]] std::vector<MachineInfo> machines();

}  // namespace stormproof::fsm
