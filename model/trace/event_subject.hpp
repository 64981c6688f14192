// What an event is about: the one place that knows which number stands in `Event::subject`.
#pragma once

#include "model/engine/event_queue.hpp"
#include "model/probe.hpp"

namespace stormproof::model::trace {

enum class Subject : std::uint8_t {
  relation,
  writer,
  participant,
  channel,
  control_relation,
  control_writer,
  pair,
  endpoint_relation,  ///< of any writer of a participant (model/cyclone/endpoints.hpp)
  endpoint_writer,
  access_point,
  packet  ///< a slot of the network, which says nothing to a reader
};

[[nodiscard]] constexpr Subject subject_of(EventKind kind) {
  switch (kind) {
    case EventKind::service_finished:
    case EventKind::dispatch:
      return Subject::channel;
    case EventKind::delayed_reception:
    case EventKind::reception:
    case EventKind::distribution:
    case EventKind::source_completion:
      return Subject::packet;
    case EventKind::announcement_due:
    case EventKind::endpoint_creation:
    case EventKind::async_run:
    case EventKind::participant_start:
    case EventKind::spdp_time:
    case EventKind::thread_run:
    case EventKind::liveliness_time:
    case EventKind::address_time:
    case EventKind::relay_expiry:
    case EventKind::relay_response:
    case EventKind::server_routine:
    case EventKind::server_routine_again:
    case EventKind::server_sending:
    case EventKind::thread_free:
      return Subject::participant;
    case EventKind::beacon:
      return Subject::access_point;
    case EventKind::client_announcement:
    case EventKind::client_sync:
    case EventKind::registration_expiry:
    case EventKind::registration_reply:
    case EventKind::registration_initial:
    case EventKind::learner_reply:
    case EventKind::learner_initial:
    case EventKind::relay_suppression_end:
    case EventKind::reply_time:
    case EventKind::lease_check:
      return Subject::pair;
    case EventKind::heartbeat_time:
      return Subject::endpoint_writer;
    case EventKind::ack_time:
      return Subject::endpoint_relation;
    case EventKind::heartbeat_expiry:
    case EventKind::cycle_start:
    case EventKind::cycle_end:
    case EventKind::batch_due:
    case EventKind::nack_response:
      return Subject::writer;
    case EventKind::control_initial_due:
    case EventKind::control_reply_due:
      return Subject::control_relation;
    case EventKind::lookup_expiry:
      return Subject::control_writer;
    case EventKind::acknack_generation:
    case EventKind::initial_acknack_due:
    case EventKind::repair_generation:
    case EventKind::suppression_end:
      return Subject::relation;
  }
  return Subject::packet;
}

[[nodiscard]] constexpr Subject subject_of(MachineRef::Kind kind) {
  switch (kind) {
    case MachineRef::Kind::relation:
      return Subject::relation;
    case MachineRef::Kind::writer:
      return Subject::writer;
    case MachineRef::Kind::participant:
      return Subject::participant;
    case MachineRef::Kind::channel:
      return Subject::channel;
    case MachineRef::Kind::control_relation:
      return Subject::control_relation;
    case MachineRef::Kind::control_writer:
      return Subject::control_writer;
    case MachineRef::Kind::pair:
      return Subject::pair;
    case MachineRef::Kind::endpoint_relation:
      return Subject::endpoint_relation;
    case MachineRef::Kind::endpoint_writer:
      return Subject::endpoint_writer;
  }
  return Subject::packet;
}

/// The name of `Event::detail` of this kind of event, or null if it has none.
[[nodiscard]] constexpr const char* detail_name(EventKind kind) {
  switch (kind) {
    case EventKind::cycle_start:
    case EventKind::cycle_end:
    case EventKind::batch_due:
      return "cycle";
    case EventKind::endpoint_creation:
      return "endpoint";
    case EventKind::reception:
      return "participant";
    case EventKind::learner_reply:
    case EventKind::learner_initial:
    case EventKind::relay_expiry:
    case EventKind::relay_response:
    case EventKind::relay_suppression_end:
      return "relay";
    default:
      return nullptr;
  }
}

}  // namespace stormproof::model::trace
