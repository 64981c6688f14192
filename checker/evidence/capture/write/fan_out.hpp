// Which packets are copies of one message. A HEARTBEAT or DATA without INFO_DST is made once and
// sent to several participants; the copies share the HEARTBEAT's count, by which a receiver knows
// them. The copies of a message are emitted in a row, each to another participant; a message with a
// HEARTBEAT goes to every matched reader in the order of matching, so the next one starts with a
// destination that the last one had, too.
#pragma once

#include <algorithm>
#include <cstdint>
#include <vector>

#include "model/engine/packet.hpp"

namespace stormproof::capture::write {

class FanOut {
 public:
  /// Whether the packet is another copy of the message of the last call; otherwise it is the first
  /// copy of a new one.
  [[nodiscard]] bool is_copy(const model::Packet& packet, std::uint32_t source,
                             std::uint32_t destination) {
    std::vector<std::uint32_t> descriptors;
    packet.descriptors.for_each([&](std::uint32_t d) { descriptors.push_back(d); });
    const bool is_same = source == source_ && packet.stream == stream_ &&
                         packet.payload_bytes == payload_bytes_ && descriptors == descriptors_ &&
                         std::ranges::find(destinations_, destination) == destinations_.end();
    if (!is_same) destinations_.clear();
    destinations_.push_back(destination);
    source_ = source;
    stream_ = packet.stream;
    payload_bytes_ = packet.payload_bytes;
    descriptors_ = std::move(descriptors);
    return is_same;
  }

 private:
  std::uint32_t source_ = UINT32_MAX;  ///< of the last packet, as the rest; at first nobody
  model::Stream stream_{};
  std::uint32_t payload_bytes_ = 0;
  std::vector<std::uint32_t> descriptors_;
  std::vector<std::uint32_t> destinations_;  ///< of the copies so far
};

}  // namespace stormproof::capture::write
