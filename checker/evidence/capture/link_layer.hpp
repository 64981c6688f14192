// From a captured frame to the IP packet in it: Ethernet (with VLAN tags), Linux cooked captures of
// both versions ("-i any"), raw IP, and loopback.
#pragma once

#include <optional>

#include "checker/evidence/capture/bytes.hpp"

namespace stormproof::capture {

/// For messages.
inline constexpr const char* supported_links =
    "Ethernet, Linux cooked (v1 or v2), raw IP or loopback";

/// `link_type` is a DLT_… number of libpcap.
[[nodiscard]] bool is_supported_link(int link_type);

/// The bytes from the IP header on; nothing if the frame holds another protocol. Empty if the frame
/// ends before that can be told.
[[nodiscard]] std::optional<Bytes> ip_packet(Bytes frame, int link_type);

}  // namespace stormproof::capture
