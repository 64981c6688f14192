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
  /// How far the clocks of captures on different hosts may be apart, ns.
  std::int64_t clock_error_ns = 0;
  /// Whether a datagram may be lost after its capture.
  bool may_lose = true;

  bool operator==(const Bounds&) const = default;
};

}  // namespace stormproof::conform
