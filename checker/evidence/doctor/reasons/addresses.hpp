// What can be told of an address without knowing the network: loopback, the bridges that container
// engines make by default, and whether two addresses may be of one network.
#pragma once

#include <algorithm>

#include "checker/evidence/capture/address.hpp"

namespace stormproof::doctor {

[[nodiscard]] inline bool is_loopback(const capture::Address& address) {
  constexpr std::uint8_t v4_loopback = 127;
  if (address.is_v4()) return address.bytes[12] == v4_loopback;
  capture::Address one{};
  one.bytes.back() = 1;
  return address == one;
}

/// 172.17.0.0/16 to 172.31.0.0/16 are what Docker takes for bridges, 10.88.0.0/16 is Podman's.
[[nodiscard]] inline bool is_container_bridge(const capture::Address& address) {
  if (!address.is_v4()) return false;
  const auto& b = address.bytes;
  return (b[12] == 172 && b[13] >= 17 && b[13] <= 31) || (b[12] == 10 && b[13] == 88);
}

/// At least a /16 in IPv4, a /64 in IPv6: wider than nearly all networks are.
[[nodiscard]] inline bool share_a_network(const capture::Address& one,
                                          const capture::Address& other) {
  if (one.is_v4() != other.is_v4()) return false;
  const auto length = one.is_v4() ? 14 : 8;
  return std::equal(one.bytes.begin(), one.bytes.begin() + length, other.bytes.begin());
}

}  // namespace stormproof::doctor
