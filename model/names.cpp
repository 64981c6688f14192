// Names of packet kinds and traffic classes, as reports and traces show them.
#include "model/engine/packet.hpp"
#include "model/run_result.hpp"

namespace stormproof::model {

const char* name_of(PacketKind kind) {
  switch (kind) {
    case PacketKind::spdp_multicast:
      return "spdp_multicast";
    case PacketKind::spdp_unicast:
      return "spdp_unicast";
    case PacketKind::data:
      return "data";
    case PacketKind::heartbeat:
      return "heartbeat";
    case PacketKind::acknack:
      return "acknack";
    case PacketKind::user_heartbeat:
      return "user_heartbeat";
    case PacketKind::user_acknack:
      return "user_acknack";
  }
  return "";
}

const char* name_of(TrafficClass traffic) {
  switch (traffic) {
    case TrafficClass::spdp:
      return "spdp";
    case TrafficClass::initial_data:
      return "initial_data";
    case TrafficClass::repair_data:
      return "repair_data";
    case TrafficClass::heartbeat:
      return "heartbeat";
    case TrafficClass::acknack:
      return "acknack";
    case TrafficClass::user_control:
      return "user_control";
  }
  return "";
}

}  // namespace stormproof::model
