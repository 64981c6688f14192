// Runs a small scenario of `implementation: fastdds` and keeps what happened in plain lists. Unlike
// tests/model/run_log.hpp it has what only this implementation has: same-host packets, what a
// HEARTBEAT announces and an ACKNACK acknowledges, who received a packet, and which descriptors a
// transition moved.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "model/engine/packet.hpp"
#include "tests/model/run_log.hpp"

namespace stormproof::model::fastdds {

inline constexpr std::uint64_t no_number = UINT64_MAX;
inline constexpr std::uint32_t everybody = UINT32_MAX;
using Times = std::vector<std::int64_t>;
using Numbers = std::vector<std::uint32_t>;

/// A packet, when it is emitted.
struct Emission {
  std::int64_t time_ns = 0;
  std::uint64_t number = no_number;  ///< same-host packets have none
  PacketKind kind{};
  std::uint32_t source = 0;
  std::uint32_t destination = everybody;
  Stream stream{};
  Numbers descriptors;
  std::int64_t bytes = 0;
  std::uint32_t detail = 0;  ///< announced descriptors, or the base, or the control-only relation
  std::uint32_t heartbeats = 0;
  bool initial = false;  ///< an initial ACKNACK
  bool looped = false;   ///< to a participant on the same host
};

struct Reception {
  std::int64_t time_ns = 0;
  std::uint64_t number = no_number;
  PacketKind kind{};
  std::uint32_t receiver = 0;
};

/// A transition of a machine.
struct Move {
  std::int64_t time_ns = 0;
  std::string what;     ///< "machine subject: before + event -> after"
  Numbers descriptors;  ///< those that moved, if the machine is about descriptors
};

struct FastddsLog {
  RunResult result;
  std::vector<Emission> sent;
  std::vector<Reception> received;
  std::vector<Scheduled> scheduled;
  std::vector<Move> moves;

  [[nodiscard]] std::vector<Emission> of(PacketKind kind, std::uint32_t source,
                                         std::uint32_t destination, Stream s = Stream::pub) const;
  [[nodiscard]] Times times_of(PacketKind kind, std::uint32_t source, std::uint32_t destination,
                               Stream s = Stream::pub) const;
  /// What `source` emits at this instant.
  [[nodiscard]] std::vector<Emission> at(std::int64_t time_ns, std::uint32_t source) const;
  /// Number of the packet that carries descriptor d from `source` to `destination`, the n-th time.
  [[nodiscard]] std::uint64_t number_of_data(std::uint32_t source, std::uint32_t destination,
                                             std::uint32_t d, std::size_t n = 0) const;
  /// When the event kind was scheduled for `subject`, and for when.
  [[nodiscard]] std::vector<std::pair<std::int64_t, std::int64_t>> timers(
      EventKind kind, std::uint32_t subject) const;
  /// The moves with this text, in order.
  [[nodiscard]] std::vector<Move> moves_of(const std::string& what) const;
};

[[nodiscard]] FastddsLog run(const Scenario& scenario);

/// A participant. Its 17 default endpoints (and the user endpoints) are created one after the
/// other, one every `step_ns`, the first one a step after its start; with 0 all at its start.
struct Node {
  std::uint32_t host = 0;
  std::int64_t start_ns = 0;
  std::int64_t step_ns = 0;
  std::uint32_t publications = 0;
  std::uint32_t subscriptions = 0;
};

/// A scenario with a constant delay of 1 ms, 2 ms by loopback, without piggybacked HEARTBEATs and
/// without SPDP replies, so that times can be worked out by hand. Timers are those of Fast DDS.
[[nodiscard]] Scenario fastdds_by_hand(const std::vector<Node>& nodes);

/// `nodes[0]` has all endpoints at its start, or creates one every `step_ns`; it is alone on host
/// 0. The others are on host 1 and create theirs so late that nothing of it is seen.
[[nodiscard]] Scenario one_writer(std::int64_t step_ns, std::uint32_t readers = 1);

}  // namespace stormproof::model::fastdds
