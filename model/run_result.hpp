// What one run of the simulator yields. Every number is exact and the same on every machine.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "model/counts.hpp"
#include "model/units.hpp"

namespace stormproof::model {

/// Why a run ended. `completed` is the end of a run that the completion of discovery ends; a run
/// with `run_until: time_limit` may have completed discovery and yet ended otherwise.
enum class RunEnd : std::uint8_t { completed, time_limit, no_more_events, interrupted };
/// "time_limit", as traces and JSON have it.
[[nodiscard]] const char* name_of(RunEnd end);

/// A descriptor that had not reached one of its receivers when the run ended.
struct MissingDescriptor {
  ParticipantId source;
  ParticipantId destination;
  Stream stream{};
  DescriptorId descriptor;
};

/// Classes of channel use; DATA packets count as initial if they carry a first transmission.
enum class TrafficClass : std::uint8_t {
  spdp,
  initial_data,
  repair_data,
  heartbeat,
  acknack,
  user_control,  ///< HEARTBEATs and ACKNACKs of control-only relations (`implementation: fastdds`)
  lookup         ///< samples that ask for types, and answers (`deployment.types`)
};
inline constexpr std::size_t traffic_class_count = 7;
[[nodiscard]] const char* name_of(TrafficClass traffic);
/// "SPDP", "initial DATA", … "user control", for people.
[[nodiscard]] const char* words_of(TrafficClass traffic);

/// How one channel was used up to the end of the run.
struct ChannelUse {
  std::string name;
  std::array<Nanoseconds, traffic_class_count> busy{};  ///< airtime by class

  [[nodiscard]] Nanoseconds total_busy() const {
    Nanoseconds sum;
    for (const Nanoseconds part : busy) sum += part;
    return sum;
  }
};

/// How many frames queues dropped (`wireless.queue`), by class.
struct DroppedFrames {
  std::array<std::uint64_t, traffic_class_count> at_stations{};       ///< on the way up
  std::array<std::uint64_t, traffic_class_count> at_access_points{};  ///< on the way down

  bool operator==(const DroppedFrames&) const = default;
};

/// The longest backlog of one participant: packets generated but not yet admitted to its source
/// queue.
struct BacklogPeak {
  std::uint64_t packets = 0;
  Nanoseconds at;  ///< when it was first reached
  std::uint64_t packets_at_end = 0;
};

/// How long one participant could not go on, up to the end of the run.
struct Waiting {
  Nanoseconds sender;  ///< its packets waited for room in its source queue, and it with them
  Nanoseconds thread;  ///< its thread was busy, or no core was free, and something waited for it
};

/// How long received packets of one class had been under way, from generation to reception.
struct Latency {
  std::uint64_t packets = 0;
  Nanoseconds backlog_sum;  ///< waiting for room in the source queue
  Nanoseconds
      service_sum;  ///< from admission to reception: waiting for the channel and being served
  Nanoseconds longest;
};

/// The journey of the packet that carried the last missing descriptor.
struct LastDelivery {
  MissingDescriptor descriptor;
  bool repair = false;
  Nanoseconds emitted;
  Nanoseconds admitted;
  Nanoseconds received;
};

/// What a run had done at some time.
struct SentUntil {
  Counts counts;
  std::uint64_t user_control = 0;
  std::uint64_t forgotten = 0;  ///< how often somebody's lease ended at somebody else
  /// Messages of all kinds since the last failure (model/life.hpp).
  std::uint64_t since_last_failure = 0;

  [[nodiscard]] std::uint64_t messages() const {
    return counts.total() + counts.gap + user_control;
  }
};

struct RunResult {
  static constexpr std::size_t missing_listed = 100;

  RunEnd end = RunEnd::no_more_events;
  Nanoseconds end_time;  ///< time of the last processed event
  /// T_disc: when discovery was complete for the last time, if it was so at the end.
  std::optional<Nanoseconds> discovery_time;
  /// With `deployment.life`: T_disc after the last failure (model/life.hpp).
  std::optional<Nanoseconds> recovery_time = {};
  /// With `deployment.life`: messages from the last start on (model/life.hpp), if there was one.
  std::optional<std::uint64_t> messages_since_last_start = {};
  /// With `deployment.life`: what had been sent when discovery was complete for the last time; of a
  /// run that did not complete it, until the end.
  std::optional<SentUntil> until_discovery = {};
  Counts counts;
  std::uint64_t user_control = 0;  ///< messages of control-only relations, in no class
  std::uint64_t events = 0;        ///< processed events
  std::uint64_t missing_count = 0;
  std::vector<MissingDescriptor> missing;     ///< the first `missing_listed` of them
  std::uint64_t useful_deliveries = 0;        ///< descriptors received for the first time
  std::uint64_t duplicate_deliveries = 0;     ///< descriptors received again
  std::uint64_t repairs_received = 0;         ///< packets of repair DATA
  std::uint64_t useful_repairs = 0;           ///< of these, those that brought a missing descriptor
  std::vector<ChannelUse> channels;           ///< empty with constant delay
  std::optional<DroppedFrames> dropped = {};  ///< if queues drop frames
  std::vector<BacklogPeak> backlog;           ///< by participant
  std::vector<Waiting> waiting;  ///< by participant, if it can: `sender: stalls`, processors
  std::array<Latency, traffic_class_count> latency{};
  std::optional<LastDelivery> last_delivery;

  /// Whether discovery was completed, whatever ended the run.
  [[nodiscard]] bool completed() const { return discovery_time.has_value(); }
};

}  // namespace stormproof::model
