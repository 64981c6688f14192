// The list of all machines, as data: for diagrams, proofs and tests that treat every machine alike.
#pragma once

#include <vector>

#include "fsm/machine_info.hpp"

namespace stormproof::fsm {

/// Every machine, in the order in which documents show them. The implementations that use them:
///
///   DescriptorRepair                                                 paper
///   DiscoveryReader, HeartbeatTimer, InitialAckNack, Announcer       both
///   Channel                                                          the network, so both
///   ChangeForReader, SingleShot, ControlWriter, ControlReader        fastdds
[[nodiscard]] std::vector<MachineInfo> machines();

}  // namespace stormproof::fsm
