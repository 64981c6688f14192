// All compositions, recorded.
#pragma once

#include <vector>

#include "fsm/program/program.hpp"

namespace stormproof::fsm::program {

/// In the order of fsm::composition::compositions().
[[nodiscard]] const std::vector<Program>& programs();

}  // namespace stormproof::fsm::program
