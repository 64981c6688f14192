// Reflects every front end, and compiles it with Boost.MSM, once.
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
#include "fsm/msm.hpp"
#include "fsm/reopening_repair.hpp"
#include "fsm/single_shot.hpp"

namespace stormproof::fsm {

template class Flyweight<DescriptorRepair>;
template class Flyweight<DiscoveryReader>;
template class Flyweight<HeartbeatTimer>;
template class Flyweight<InitialAckNack>;
template class Flyweight<Announcer>;
template class Flyweight<Channel>;
template class Flyweight<ChangeForReader>;
template class Flyweight<SingleShot>;
template class Flyweight<ControlWriter>;
template class Flyweight<ControlReader>;
template class Flyweight<CautiousReader>;
template class Flyweight<MatchedReader>;
template class Flyweight<HeartbeatPacer>;
template class Flyweight<EventThread>;
template class Flyweight<MovableTimer>;
template class Flyweight<ReopeningRepair>;

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
