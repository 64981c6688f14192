// "Every required descriptor key verified present": a capture that lost packets, or that ends too
// early, must not be counted as a complete discovery without anybody noticing.
//
// Required is the latest description of each endpoint that is not gone, from its participant to
// each participant on another host (to every other one, if there is only one host). A multicast
// DATA is present for all of them. Descriptors are known from the capture itself: from DATA that
// went to anybody, and from the range of the HEARTBEATs, so one that was lost everywhere is missed,
// too.
#pragma once

#include "checker/evidence/capture/counting.hpp"

namespace stormproof::capture {

/// Fills `required`, `missing` and `last_initial_ns` from the events until the cut.
void check_keys(const Conversation& conversation, Counting& counting);

}  // namespace stormproof::capture
