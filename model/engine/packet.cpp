// Names of packet kinds, as reports and traces show them.
#include "model/engine/packet.hpp"

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
    case PacketKind::lookup:
      return "lookup";
    case PacketKind::rtps_message:
      return "message";
    case PacketKind::registration:
      return "registration";
    case PacketKind::registration_heartbeat:
      return "registration_heartbeat";
    case PacketKind::registration_acknack:
      return "registration_acknack";
    case PacketKind::relayed:
      return "relayed";
    case PacketKind::relayed_acknack:
      return "relayed_acknack";
  }
  return "";
}

}  // namespace stormproof::model
