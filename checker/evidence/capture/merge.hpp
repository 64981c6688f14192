// Captures of several hosts, taken together: a datagram that was seen at its source and again at a
// receiver counts once (the paper's "source-side captures are merged without double counting").
//
// Datagrams are the same if addresses, ports, IP identification and payload are; the k-th of equal
// ones in one capture is the k-th of them in another. Each counts at the time of the capture that
// belongs to its source address: the one that sees this source's datagrams first, or alone, most
// often. (That takes clocks that are synchronised better than a transmission takes, but so does any
// order of events across hosts; the counts do not depend on it.)
#pragma once

#include <compare>
#include <cstdint>
#include <span>
#include <vector>

#include "checker/evidence/capture/address.hpp"
#include "checker/evidence/capture/bytes.hpp"

namespace stormproof::capture {

struct Sighting {
  std::int64_t time_ns = 0;
  std::uint32_t capture = 0;
  UdpEnd source{};
  UdpEnd destination{};
  std::uint32_t ip_id = 0;
  std::size_t length = 0;
  std::uint64_t digest = 0;  ///< of the payload
};
[[nodiscard]] std::uint64_t digest_of(Bytes payload);

/// For each sighting, whether it is the one that counts.
[[nodiscard]] std::vector<bool> merge(std::span<const Sighting> sightings);

}  // namespace stormproof::capture
