// What a variable of a zone stands for: a pending event of the relations, a packet in flight, or a
// mark in the past. The slots of a state stand in the order of their insertion, which decides
// between same-time events of one class.
#pragma once

#include <cstdint>
#include <type_traits>

#include "model/engine/event_queue.hpp"

namespace stormproof::explorer {

/// The set of descriptor d alone.
[[nodiscard]] constexpr std::uint16_t member(unsigned d) {
  return static_cast<std::uint16_t>(1U << d);
}

/// The interval of initial ACKNACKs doubles no more often than this.
inline constexpr std::uint8_t last_doubling = 6;

enum class What : std::uint8_t {
  // Pending.
  data,               ///< reception of DATA; `set`: its descriptors
  heartbeat,          ///< reception of a HEARTBEAT
  acknack,            ///< reception of an ACKNACK; `set`: its bitmap
  source_completion,  ///< repair DATA leave the source; `set`: their descriptors
  heartbeat_expiry,
  acknack_generation,
  initial_acknack_due,
  repair_generation,
  suppression_end,
  nack_response,   ///< Fast DDS
  async_run,       ///< Fast DDS
  heartbeat_time,  ///< Cyclone DDS: a time that the HEARTBEAT timer was moved to
  ack_time,        ///< Cyclone DDS: the same of the ACK timer
  thread_run,      ///< Cyclone DDS; `number`: of which participant, 0 is the writer's
  creation,        ///< a descriptor comes into being after the match; `set`: which
  reader_opens,    ///< the reader processes the writer's announcement
  writer_opens,    ///< the writer processes the reader's announcement
  // Past.
  repair_left,  ///< the last repair of the descriptor in `set` left the source
  opened,       ///< the relation opened
  completed,    ///< the reader received its last descriptor
  // Cyclone DDS: past or still to come.
  last_heartbeat,          ///< when the last periodic HEARTBEAT was made
  heartbeat_counts_until,  ///< how long the count of the last HEARTBEAT matters
  acknack_counts_until,
  quiet_until,  ///< the reader does not say the same again
  hush_until,   ///< nor asks for the same again
  again_at,     ///< then it asks again by itself
};

[[nodiscard]] constexpr bool is_mark(What what) { return what >= What::repair_left; }
[[nodiscard]] constexpr bool is_packet(What what) { return what <= What::acknack; }
[[nodiscard]] constexpr bool from_writer(What what) { return what <= What::heartbeat; }

/// It belongs to one reader's relations; otherwise to a writer or its participant.
[[nodiscard]] constexpr bool is_of_reader(What what) {
  return !is_mark(what) && what != What::heartbeat_expiry && what != What::nack_response &&
         what != What::async_run && what != What::heartbeat_time && what != What::thread_run &&
         what != What::creation;
}
/// It belongs to one writer's relations or to the writer; otherwise to the participant, whose
/// announcement opens the relations of all its writers.
[[nodiscard]] constexpr bool is_of_writer(What what) {
  return !is_mark(what) && what != What::async_run && what != What::thread_run &&
         what != What::reader_opens && what != What::writer_opens;
}

struct Slot {
  What what{};
  std::uint8_t flags = 0;
  std::uint16_t set = 0;    ///< descriptors, bit d is descriptor d
  std::uint8_t number = 0;  ///< what a HEARTBEAT announces; the base of an ACKNACK
  /// The relation that it belongs to: with w writers, s + w·r is that of writer s with reader r. Of
  /// what is a writer's own that with reader 0, of what is a reader's own that with writer 0; 0 for
  /// what is the participant's.
  std::uint8_t relation = 0;

  /// Of a HEARTBEAT or ACKNACK of Cyclone DDS, in comparison with the others that there are.
  std::uint16_t count = 0;

  static constexpr std::uint8_t carries_heartbeat = 1;  ///< DATA, and a HEARTBEAT behind them
  static constexpr std::uint8_t initial = 2;            ///< ACKNACK marked initial
  static constexpr std::uint8_t from_repair = 4;        ///< DATA made by repair generation
  static constexpr std::uint8_t directed = 8;           ///< HEARTBEAT meant for its reader alone
  static constexpr std::uint8_t to_set = 16;            ///< a message to all readers that there are
  static constexpr std::uint8_t goes_on = 32;           ///< the packet has another part behind it

  [[nodiscard]] bool has(std::uint8_t flag) const { return (flags & flag) != 0; }
  bool operator==(const Slot&) const = default;
};
// Slots are compared and hashed bytewise.
static_assert(std::has_unique_object_representations_v<Slot>);

/// Two packets; the participant has so many writers.
[[nodiscard]] constexpr bool have_one_source(const Slot& a, const Slot& b, unsigned writers) {
  if (from_writer(a.what) != from_writer(b.what)) return false;
  return from_writer(a.what) || a.relation / writers == b.relation / writers;
}

/// The simulator's kind of event. Packets are received after the constant delay of their own.
[[nodiscard]] constexpr model::EventKind kind_of(What what, bool receives_separately) {
  switch (what) {
    case What::source_completion:
      return model::EventKind::source_completion;
    case What::heartbeat_expiry:
      return model::EventKind::heartbeat_expiry;
    case What::acknack_generation:
      return model::EventKind::acknack_generation;
    case What::initial_acknack_due:
      return model::EventKind::initial_acknack_due;
    case What::repair_generation:
      return model::EventKind::repair_generation;
    case What::suppression_end:
      return model::EventKind::suppression_end;
    case What::nack_response:
      return model::EventKind::nack_response;
    case What::async_run:
      return model::EventKind::async_run;
    case What::heartbeat_time:
      return model::EventKind::heartbeat_time;
    case What::ack_time:
      return model::EventKind::ack_time;
    case What::thread_run:
      return model::EventKind::thread_run;
    case What::creation:
      return model::EventKind::endpoint_creation;
    default:  // packets, the announcements among them
      return receives_separately ? model::EventKind::reception
                                 : model::EventKind::delayed_reception;
  }
}

}  // namespace stormproof::explorer
