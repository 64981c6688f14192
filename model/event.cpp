// Names of event kinds and classes, as traces show them.
#include "model/event.hpp"

#include <array>

namespace stormproof::model {

const char* name_of(EventKind kind) {
  static constexpr std::array<const char*, event_kind_count> names{"service_finished",
                                                                   "delayed_reception",
                                                                   "distribution",
                                                                   "beacon",
                                                                   "reception",
                                                                   "announcement_due",
                                                                   "heartbeat_expiry",
                                                                   "acknack_generation",
                                                                   "initial_acknack",
                                                                   "repair_generation",
                                                                   "suppression_end",
                                                                   "source_completion",
                                                                   "cycle_start",
                                                                   "cycle_end",
                                                                   "batch_due",
                                                                   "endpoint_creation",
                                                                   "nack_response",
                                                                   "async_run",
                                                                   "control_initial",
                                                                   "control_reply",
                                                                   "lookup_expiry",
                                                                   "participant_start",
                                                                   "spdp_time",
                                                                   "reply_time",
                                                                   "lease_check",
                                                                   "heartbeat_time",
                                                                   "ack_time",
                                                                   "thread_run",
                                                                   "liveliness_time",
                                                                   "address_time",
                                                                   "client_announcement",
                                                                   "client_sync",
                                                                   "registration_expiry",
                                                                   "registration_reply",
                                                                   "registration_initial",
                                                                   "learner_reply",
                                                                   "learner_initial",
                                                                   "relay_expiry",
                                                                   "relay_response",
                                                                   "relay_suppression_end",
                                                                   "server_routine",
                                                                   "server_routine_again",
                                                                   "server_sending",
                                                                   "thread_free",
                                                                   "dispatch"};
  return names[static_cast<std::size_t>(kind)];
}

const char* name_of(EventClass event_class) {
  switch (event_class) {
    case EventClass::service:
      return "service";
    case EventClass::protocol:
      return "protocol";
    case EventClass::dispatch:
      return "dispatch";
  }
  return "";
}

}  // namespace stormproof::model
