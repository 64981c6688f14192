// Which version of a library a participant runs, as far as its DATA(p) shows. No version is sent
// before Fast DDS 3, but what a version added is there or not:
//
// * Fast DDS from 3.0.0 on and Connext send PID_PRODUCT_VERSION (0x8000): four octets.
// * Fast DDS from 2.12.0 on sends PID_NETWORK_CONFIGURATION_SET (0x8007); 2.6 to 2.11 do not.
// * Cyclone DDS sends, under the same number, "host/version/system/…" behind some flags.
#pragma once

#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <utility>

#include "checker/evidence/capture/bytes.hpp"
#include "checker/evidence/capture/identifiers.hpp"

namespace stormproof::capture {

/// PID_PRODUCT_VERSION.
inline constexpr std::uint16_t product_version = 0x8000;

/// The parameters of a DATA(p) whose numbers a vendor gave, by number.
using VendorParameters = std::map<std::uint16_t, Bytes>;

/// "3.2.5", "0.10.2"; "2.x before 2.12" and "2.x from 2.12 on" where no more is sent; empty if
/// nothing is known. Nothing in it is a control character.
[[nodiscard]] std::string library_version(VendorId vendor, const VendorParameters& parameters,
                                          ByteOrder order);

/// The first two numbers in `text`: 2 and 12 of "2.x from 2.12 on", 3 and 6 of "fastdds-3.6".
[[nodiscard]] std::optional<std::pair<unsigned, unsigned>> version_in(std::string_view text);

}  // namespace stormproof::capture
