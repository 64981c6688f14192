// Names of traffic classes and ends of runs, as reports and traces show them.
#include "model/run_result.hpp"

namespace stormproof::model {

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
    case TrafficClass::lookup:
      return "lookup";
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
    case TrafficClass::lookup:
      return "lookups";
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
