// The headers of one IP packet, version 4 or 6, reduced to what reassembly needs. A capture may
// hold anything, so every length is checked; checksums are not, because a capture at the sender is
// taken before the network interface fills them in.
#pragma once

#include <optional>

#include "checker/evidence/capture/address.hpp"
#include "checker/evidence/capture/bytes.hpp"

namespace stormproof::capture {

struct IpPacket {
  Address source{};
  Address destination{};
  std::uint32_t id = 0;  ///< the identification that fragments share; 0 in IPv6 without them
  std::uint8_t protocol = 0;
  std::uint8_t time_to_live = 0;
  std::size_t offset = 0;  ///< of the payload in its datagram, in bytes
  bool more = false;       ///< fragments follow this one
  bool is_cut = false;     ///< the header promises more bytes than were captured
  Bytes payload{};         ///< without headers and link padding

  [[nodiscard]] bool is_fragment() const { return more || offset > 0; }
};

/// Nothing if this is not an IP packet, or its headers contradict themselves.
[[nodiscard]] std::optional<IpPacket> parse_ip(Bytes bytes);

}  // namespace stormproof::capture
