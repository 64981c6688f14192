// Where datagrams come from and go to: IP addresses of both versions in one type, with a UDP port.
#pragma once

#include <array>
#include <compare>
#include <cstdint>
#include <string>

#include "checker/evidence/capture/bytes.hpp"

namespace stormproof::capture {

/// An IPv6 address, or an IPv4 address as ::ffff:a.b.c.d.
struct Address {
  std::array<std::uint8_t, 16> bytes{};

  /// `address` has 4 or 16 bytes; anything else gives the unspecified address.
  [[nodiscard]] static Address from(Bytes address);
  [[nodiscard]] bool is_v4() const;
  [[nodiscard]] bool is_multicast() const;

  auto operator<=>(const Address&) const = default;
};
/// "10.0.0.1", "fe80::1".
[[nodiscard]] std::string to_string(const Address& address);

/// An address and a UDP port: one end of a datagram, or a locator that a participant announces.
struct UdpEnd {
  Address address{};
  std::uint16_t port = 0;

  auto operator<=>(const UdpEnd&) const = default;
};
/// "10.0.0.1:7410", "[fe80::1]:7410".
[[nodiscard]] std::string to_string(const UdpEnd& end);

}  // namespace stormproof::capture
