// The test vectors of `service: unit`, `sender: stalls` and `count_at: admission`: lists of packets
// on the channel alone, with the time at which each has arrived, and whole runs of Fast DDS.
// Implementations that were written apart agree on them exactly.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "model/scenario.hpp"
#include "tests/vectors/fastdds_vectors.hpp"

namespace stormproof::vectors {

/// One packet; each host has one participant, with its number.
struct ChannelPacket {
  std::int64_t time_ns = 0;
  std::uint32_t source = 0;
  std::optional<std::uint32_t> destination;  ///< none: multicast
  std::uint32_t payload_bytes = 0;
  std::uint8_t port = 0;  ///< of its flow
};

struct ChannelVector {
  std::string name;
  model::WirelessProfile wireless;
  std::uint32_t hosts = 2;
  std::vector<ChannelPacket> packets;    ///< by time
  std::vector<std::int64_t> arrived_ns;  ///< of each: the end of its last fragment
};

inline std::ostream& operator<<(std::ostream& out, const ChannelVector& vector) {
  return out << vector.name;
}

/// 802.11n with A-MPDU: turns of transmitters, the access point's oldest queue, no flows.
[[nodiscard]] model::WirelessProfile units_of_80211n();

[[nodiscard]] const std::vector<ChannelVector>& channel_vectors();
[[nodiscard]] const std::vector<Vector>& wifi_vectors();

}  // namespace stormproof::vectors
