// The ports of RTPS (2.5, section 9.6.2.3) with the parameters that every vendor has by default:
// which domain a group's port is for, and the number of the participant that listens on a port.
#pragma once

#include <cstdint>
#include <optional>

namespace stormproof::doctor {

inline constexpr std::uint32_t first_port = 7400;
inline constexpr std::uint32_t ports_of_domain = 250;
inline constexpr std::uint32_t first_unicast_port = 10;

/// The domain whose participants announce themselves on this port of a group.
[[nodiscard]] constexpr std::optional<std::uint32_t> domain_of_group(std::uint32_t port) {
  if (port < first_port || (port - first_port) % ports_of_domain != 0) return std::nullopt;
  return (port - first_port) / ports_of_domain;
}
/// The number on its host of the participant with this port for metatraffic.
[[nodiscard]] constexpr std::optional<std::uint32_t> participant_of_port(std::uint32_t port) {
  if (port < first_port) return std::nullopt;
  const std::uint32_t offset = (port - first_port) % ports_of_domain;
  if (offset < first_unicast_port || (offset - first_unicast_port) % 2 != 0) return std::nullopt;
  return (offset - first_unicast_port) / 2;
}

}  // namespace stormproof::doctor
