// The events of a run: their kinds, and the class of each kind, which orders events of the same
// instant (specs/guide/model.md, "Events and their order"). Whoever observes a run, or changes how
// its events are scheduled, needs no more than this; the queue is model/engine/event_queue.hpp.
#pragma once

#include <cstddef>
#include <cstdint>

#include "model/event_order.hpp"
#include "model/units.hpp"

namespace stormproof::model {

enum class EventClass : std::uint8_t { service = 0, protocol = 1, dispatch = 2 };

enum class EventKind : std::uint8_t {
  service_finished,     ///< subject: channel
  delayed_reception,    ///< subject: packet slot (constant delay)
  distribution,         ///< subject: packet slot (of a wired host)
  beacon,               ///< subject: access point
  reception,            ///< subject: packet slot, detail: receiving participant
  announcement_due,     ///< subject: participant
  heartbeat_expiry,     ///< subject: writer
  acknack_generation,   ///< subject: relation
  initial_acknack_due,  ///< subject: relation
  repair_generation,    ///< subject: relation
  suppression_end,      ///< subject: relation
  source_completion,    ///< subject: packet slot (constant delay)
  cycle_start,          ///< subject: writer, detail: cycle token
  cycle_end,            ///< subject: writer, detail: cycle token
  batch_due,            ///< subject: writer, detail: cycle token
  endpoint_creation,    ///< subject: participant, detail: which of its endpoints
  nack_response,        ///< subject: writer
  async_run,            ///< subject: participant
  control_initial_due,  ///< subject: control-only relation
  control_reply_due,    ///< subject: control-only relation
  lookup_expiry,        ///< subject: control-only writer
  participant_start,    ///< subject: participant
  spdp_time,            ///< subject: participant
  reply_time,           ///< subject: pair
  lease_check,          ///< subject: pair, who is remembered and who remembers
  heartbeat_time,       ///< subject: writer of Cyclone DDS
  ack_time,             ///< subject: relation of Cyclone DDS
  thread_run,           ///< subject: participant
  liveliness_time,      ///< subject: participant of Cyclone DDS
  address_time,         ///< subject: participant of Cyclone DDS
  // With a Discovery Server; of one of its writers: detail: which (model/fastdds/relay.hpp).
  client_announcement,    ///< subject: pair of client and server
  client_sync,            ///< subject: pair of client and server
  registration_expiry,    ///< subject: pair of client and server
  registration_reply,     ///< subject: pair of client and server
  registration_initial,   ///< subject: pair of client and server
  learner_reply,          ///< subject: pair of server and client
  learner_initial,        ///< subject: pair of server and client
  relay_expiry,           ///< subject: the server
  relay_response,         ///< subject: the server
  relay_suppression_end,  ///< subject: pair of server and client
  server_routine,         ///< subject: the server
  server_routine_again,   ///< subject: the server, detail: which one still counts
  server_sending,         ///< subject: the server
  thread_free,            ///< subject: participant
  dispatch,               ///< subject: channel
};
inline constexpr std::size_t event_kind_count = static_cast<std::size_t>(EventKind::dispatch) + 1;

[[nodiscard]] constexpr EventClass class_of(EventKind kind) {
  if (kind <= EventKind::reception) return EventClass::service;
  return kind == EventKind::dispatch ? EventClass::dispatch : EventClass::protocol;
}
[[nodiscard]] const char* name_of(EventKind kind);
[[nodiscard]] const char* name_of(EventClass event_class);

struct Event {
  Nanoseconds time;
  std::uint64_t order = 0;  ///< class in the top two bits, insertion number below
  std::uint32_t subject = 0;
  std::uint32_t detail = 0;
  EventKind kind{};

  [[nodiscard]] std::uint64_t insertion() const { return order & ((std::uint64_t{1} << 62) - 1); }
  [[nodiscard]] EventClass event_class() const { return static_cast<EventClass>(order >> 62); }
  [[nodiscard]] bool before(const Event& other) const {
    return is_before(time, order, other.time, other.order);
  }
};

}  // namespace stormproof::model
