// The network without a protocol: packets that a list gives, and when each has arrived.
#pragma once

#include <cstdint>
#include <vector>

#include "model/scenario.hpp"
#include "tests/vectors/wifi_vectors.hpp"

namespace stormproof {

/// When each packet reached its last receiver, or −1. Each host has one participant, with its
/// number.
[[nodiscard]] std::vector<std::int64_t> arrivals(
    const model::WirelessProfile& wireless, std::uint32_t hosts,
    const std::vector<vectors::ChannelPacket>& packets);

}  // namespace stormproof
