// Reflects every front end once.
#include "fsm/machines.hpp"

#include "fsm/announcer.hpp"
#include "fsm/channel.hpp"
#include "fsm/descriptor_repair.hpp"
#include "fsm/discovery_reader.hpp"
#include "fsm/heartbeat_timer.hpp"
#include "fsm/initial_acknack.hpp"

namespace stormproof::fsm {

std::vector<MachineInfo> machines() {
  return {Reflect<DescriptorRepair>::info(), Reflect<DiscoveryReader>::info(),
          Reflect<HeartbeatTimer>::info(),   Reflect<InitialAckNack>::info(),
          Reflect<Announcer>::info(),        Reflect<Channel>::info()};
}

}  // namespace stormproof::fsm
