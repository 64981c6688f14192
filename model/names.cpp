// Names of packet kinds, traffic classes and ends of runs, as reports and traces show them.
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
      return name_of(MessageClass::initial_data);
    case TrafficClass::repair_data:
      return name_of(MessageClass::repair_data);
    case TrafficClass::heartbeat:
      return name_of(MessageClass::heartbeat);
    case TrafficClass::acknack:
      return name_of(MessageClass::acknack);
    case TrafficClass::user_control:
      return "user_control";
  }
  return "";
}

const char* words_of(TrafficClass traffic) {
  switch (traffic) {
    case TrafficClass::spdp:
      return "SPDP";
    case TrafficClass::initial_data:
      return words_of(MessageClass::initial_data);
    case TrafficClass::repair_data:
      return words_of(MessageClass::repair_data);
    case TrafficClass::heartbeat:
      return words_of(MessageClass::heartbeat);
    case TrafficClass::acknack:
      return words_of(MessageClass::acknack);
    case TrafficClass::user_control:
      return "user control";
  }
  return "";
}

const char* name_of(RunEnd end) {
  switch (end) {
    case RunEnd::completed:
      return "completed";
    case RunEnd::time_limit:
      return "time_limit";
    case RunEnd::no_more_events:
      return "no_more_events";
    case RunEnd::interrupted:
      return "interrupted";
  }
  return "";
}

}  // namespace stormproof::model
