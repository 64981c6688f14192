// Reflects every front end once.
#include "fsm/machines.hpp"

#include "fsm/announcer.hpp"
#include "fsm/cautious_reader.hpp"
#include "fsm/change_for_reader.hpp"
#include "fsm/channel.hpp"
#include "fsm/control_relation.hpp"
#include "fsm/descriptor_repair.hpp"
#include "fsm/discovery_reader.hpp"
#include "fsm/event_thread.hpp"
#include "fsm/heartbeat_pacer.hpp"
#include "fsm/heartbeat_timer.hpp"
#include "fsm/initial_acknack.hpp"
#include "fsm/matched_reader.hpp"
#include "fsm/movable_timer.hpp"
#include "fsm/reflect.hpp"
#include "fsm/reopening_repair.hpp"
#include "fsm/single_shot.hpp"

namespace stormproof::fsm {

std::vector<MachineInfo> machines() {
  return {Reflect<DescriptorRepair>::info(), Reflect<DiscoveryReader>::info(),
          Reflect<HeartbeatTimer>::info(),   Reflect<InitialAckNack>::info(),
          Reflect<Announcer>::info(),        Reflect<Channel>::info(),
          Reflect<ChangeForReader>::info(),  Reflect<SingleShot>::info(),
          Reflect<ControlWriter>::info(),    Reflect<ControlReader>::info(),
          Reflect<CautiousReader>::info(),   Reflect<MatchedReader>::info(),
          Reflect<HeartbeatPacer>::info(),   Reflect<EventThread>::info(),
          Reflect<MovableTimer>::info(),     Reflect<ReopeningRepair>::info()};
}

}  // namespace stormproof::fsm
