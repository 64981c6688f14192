// Addresses that users write into files and variables: what no library can reach, because nothing
// is there, a placeholder of a tutorial was left as it is, or the numbers are none.
#pragma once

#include <string>
#include <string_view>

namespace stormproof::model::config::vendor {

/// Why a text is neither an IP address nor the name of a host; empty if it may be one. Whether
/// somebody has the name is not asked.
[[nodiscard]] std::string why_no_address(std::string_view text);

/// The same of an address as Cyclone DDS and Fast DDS take it with a port behind it: "192.0.2.1",
/// "192.0.2.1:7410", "robot.local", "[2001:db8::1]:7410".
[[nodiscard]] std::string why_no_endpoint(std::string_view text);

}  // namespace stormproof::model::config::vendor
