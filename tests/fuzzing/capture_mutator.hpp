// Mistakes in captures that a random change of bytes hardly makes: the file, its packets and their
// RTPS messages stay readable, and one number means something else. A sequence number from nowhere
// or a bitmap of 2^31 bits is where readers of captures run out of memory or time.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

namespace stormproof::fuzzing {

using CaptureBytes = std::vector<std::uint8_t>;

/// `capture` with one to three such mistakes: a sequence number, a number of bits, an entity or a
/// length of a submessage, a time, or a packet that is missing, twice or in another place. The same
/// seed makes the same. A file that is no little-endian pcap with an RTPS message stays as it is.
[[nodiscard]] CaptureBytes with_mistakes(const CaptureBytes& capture, std::uint64_t seed);

}  // namespace stormproof::fuzzing
