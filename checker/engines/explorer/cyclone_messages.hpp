// Messages of an explored relation of Cyclone DDS as slots, and as what the simulator packs: the
// explored thread fills packets with the simulator's packer (model/cyclone/packer.hpp), and a run
// of the simulator is compared with a path, part by part.
#pragma once

#include <span>
#include <vector>

#include "checker/engines/explorer/slot.hpp"
#include "model/cyclone/packer.hpp"

namespace stormproof::explorer {

/// What participant 0 tells participant 1 about its publications, or is answered.
[[nodiscard]] model::cyclone::Message message_of(const Slot& slot);

/// The parts of a packet that are about these publications, in their order: consecutive samples are
/// one part, with the HEARTBEAT behind them if there is one. All but the last one go on.
[[nodiscard]] std::vector<Slot> parts_of(std::span<const model::Submessage> contents);

}  // namespace stormproof::explorer
