// What a capture cannot show, and within which bounds it is chosen: delays, losses, the lateness of
// timers and threads, and how far the clocks of two captures are apart. Conformance is relative to
// these bounds; reports name them.
#pragma once

#include <cstdint>

namespace stormproof::conform {

struct Bounds {
  /// From the capture of a datagram at its source to its reception, ns. Between two participants
  /// datagrams arrive in order.
  std::int64_t least_delay_ns = 0;
  std::int64_t most_delay_ns = 60'000'000'000;
  /// From the instant at which a rule sends (serialization) to the capture of the datagram, ns: the
  /// thread may be preempted or wait for room in the socket.
  std::int64_t most_send_lag_ns = 50'000'000;
  /// A timer never acts early, but up to this much late, ns: one thread serves all of a
  /// participant's.
  std::int64_t most_lateness_ns = 150'000'000;
  /// How old the clock may be from which the first initial ACKNACK waits, ns: the thread that
  /// serves the timers reads it, and may be kept waiting before it takes the timer up.
  std::int64_t most_clock_age_ns = 10'000'000;
  /// How long what participants of one host exchange goes on after the last endpoint was created
  /// and the last of them was announced, ns. A capture between hosts does not show it.
  std::int64_t most_same_host_ns = 1'000'000'000;
  /// How far the clocks of captures on different hosts may be apart, ns.
  std::int64_t clock_error_ns = 0;
  /// Whether a datagram may be lost after its capture.
  bool may_lose = true;
  /// How long a message may wait in the queue of a Cyclone DDS participant's thread, ns: the thread
  /// serves its timers first, and sends one copy after the other.
  std::int64_t most_queueing_ns = 2'000'000'000;

  bool operator==(const Bounds&) const = default;
};

}  // namespace stormproof::conform
