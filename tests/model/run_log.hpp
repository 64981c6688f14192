// Runs a small scenario and keeps what happened in plain lists, so that a test can say "the second
// HEARTBEAT leaves at …" in one line. Times are nanoseconds; packets that one record stands for
// appear one by one.
#pragma once

#include <cstdint>
#include <functional>
#include <string>
#include <vector>

#include "model/engine/packet.hpp"
#include "model/simulator.hpp"

namespace stormproof::model {

inline constexpr std::int64_t ms = 1'000'000;
inline constexpr std::int64_t sec = 1'000'000'000;

struct Sent {
  static constexpr std::uint32_t everybody = UINT32_MAX;

  std::uint64_t number = 0;
  std::int64_t time_ns = 0;
  PacketKind kind{};
  std::uint32_t source = 0;
  std::uint32_t destination = everybody;
  Stream stream{};
  std::vector<std::uint32_t> descriptors;
  std::int64_t payload_bytes = 0;
  bool from_repair = false;
  std::uint8_t port = 0;  ///< of its flow
};

struct Service {
  std::int64_t from_ns = 0;
  std::int64_t until_ns = 0;
  std::uint32_t channel = 0;
  std::uint32_t stage = 0;
  std::uint32_t fragment = 0;
  std::uint64_t packet = 0;
  PacketKind kind{};
};

struct Scheduled {
  std::int64_t at_ns = 0;   ///< when it was scheduled
  std::int64_t due_ns = 0;  ///< for when
  EventKind kind{};
  std::uint32_t subject = 0;
};

struct Arrived {
  std::int64_t time_ns = 0;
  std::uint64_t packet = 0;
  bool lost = false;
};

struct RunLog {
  RunResult result;
  std::vector<Sent> sent;
  std::vector<Service> services;
  std::vector<Scheduled> scheduled;
  std::vector<Arrived> arrived;
  std::vector<std::string> transitions;  ///< "machine subject: before + event -> after"

  /// Packets of one kind from `source` to `destination` on stream `s`.
  [[nodiscard]] std::vector<Sent> of(PacketKind kind, std::uint32_t source,
                                     std::uint32_t destination, Stream s = Stream::pub) const;
  [[nodiscard]] std::vector<std::int64_t> times_of(PacketKind kind, std::uint32_t source,
                                                   std::uint32_t destination,
                                                   Stream s = Stream::pub) const;
  /// How often the event kind was scheduled for `subject`.
  [[nodiscard]] std::vector<Scheduled> scheduled_of(EventKind kind, std::uint32_t subject) const;
};

/// Runs the scenario, with a deliberate mistake in the rules if there is one.
[[nodiscard]] RunLog run_and_log(const Scenario& scenario, const Mutation* mutation = nullptr);

/// Participants of one default-free deployment: so many publications and no subscriptions on the
/// given hosts.
struct Node {
  std::uint32_t host;
  std::uint32_t publications;
  std::int64_t start_ns = 0;
  std::uint32_t subscriptions = 0;
};

/// A scenario without default descriptors, without piggybacked HEARTBEATs and with a constant
/// delay, so that times can be worked out by hand.
[[nodiscard]] Scenario by_hand(const std::vector<Node>& nodes, std::int64_t one_way_ns = ms);

}  // namespace stormproof::model
