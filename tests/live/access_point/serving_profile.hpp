// The wireless profile of the access point: read like every profile of the project, and refused
// where a device that sees frames, not datagrams, cannot do what the profile says.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "model/config/tree/result.hpp"
#include "model/wireless_profile.hpp"

namespace stormproof::live {

/// The access point serves an infrastructure network on one channel: an uplink and a downlink,
/// frame by frame. Says what in the profile is something else; nothing if it can be served.
[[nodiscard]] std::optional<std::string> why_not_served(const model::WirelessProfile& wireless);

/// What in the profile is not the access point's to decide: the hosts are real, and their kernels
/// send all fragments of a datagram at once from a socket's buffer.
[[nodiscard]] std::vector<std::string> left_to_the_hosts(const model::WirelessProfile& wireless);

/// Reads a profile by name or path. `overrides` are "key=value"; `overhead`, if not empty, is a
/// duration for both overheads and goes over them.
[[nodiscard]] model::config::Result<model::WirelessProfile> read_serving_profile(
    const std::string& reference, std::vector<std::string> overrides, const std::string& overhead);

}  // namespace stormproof::live
