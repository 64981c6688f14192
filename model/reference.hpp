// What a run is compared with: the failure-free reference (how many messages discovery needs when
// nothing is late) and the open-loop baseline (how much airtime its first transmissions need when
// nothing feeds back).
#pragma once

#include <optional>

#include "model/counts.hpp"
#include "model/scenario.hpp"

namespace stormproof::model {

/// The failure-free reference of the paper: every descriptor is generated once per receiver, one
/// HEARTBEAT and one ACKNACK per relation (α_HB = α_ACK = 1), and SPDP as it follows from
/// recognising each peer once after announcement 0: with `resend: all_known` 1 + p multicasts and
/// p(p + 1)/2 copies of a participant with p cross-host peers. Fast DDS recognises the n − 1 others
/// of all hosts: n multicasts and n·p/2 cross-host copies.
[[nodiscard]] Counts failure_free_reference(const Scenario& scenario);

/// The open-loop baseline: the airtime, over all stages of the route, of each relation's
/// descriptors grouped into packets, one HEARTBEAT and one ACKNACK with a bitmap of one word, and
/// of (1 + p) multicast and p(p + 1)/2 unicast announcements per participant with p cross-host
/// peers. No value with `constant_delay`, which has no channel.
[[nodiscard]] std::optional<Nanoseconds> open_loop_airtime(const Scenario& scenario);

}  // namespace stormproof::model
