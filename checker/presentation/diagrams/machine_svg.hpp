// The SVG diagram of a machine.
#pragma once

#include <string>

#include "fsm/machine_info.hpp"

namespace stormproof::draw {

[[nodiscard]] std::string machine_svg(const fsm::MachineInfo& machine);

}  // namespace stormproof::draw
