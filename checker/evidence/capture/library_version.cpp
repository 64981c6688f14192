// Reads the versions that vendors put into DATA(p).
#include "checker/evidence/capture/library_version.hpp"

#include <algorithm>
#include <charconv>

#include <fmt/format.h>

namespace stormproof::capture {

namespace {

constexpr std::uint16_t network_configuration_set = 0x8007;
constexpr std::uint16_t cyclonedds_version_info = 0x8007;
constexpr VendorId connext_vendor = 0x0101;
constexpr VendorId cyclonedds_vendor = 0x0110;

/// Major, minor, patch; empty if the octets are not there.
std::string from_octets(Bytes value) {
  if (value.size() < 4) return "";
  return fmt::format("{}.{}.{}", value[0], value[1], value[2]);
}

/// The second word of the CDR string behind the flags, if it looks like a version.
std::string from_version_info(Bytes value, ByteOrder order) {
  constexpr std::size_t flags = 20;
  Cursor cursor{value, order};
  cursor.skip(flags);
  const Bytes text = cursor.take(cursor.u32());
  if (cursor.failed()) return "";
  const auto first = std::ranges::find(text, static_cast<std::uint8_t>('/'));
  if (first == text.end()) return "";
  const auto last = std::find(first + 1, text.end(), static_cast<std::uint8_t>('/'));
  const std::string version{first + 1, last};
  const bool is_version = !version.empty() && version.size() < 32 &&
                          version.find_first_not_of("0123456789.") == std::string::npos;
  return is_version ? version : "";
}

}  // namespace

std::string library_version(VendorId vendor, const VendorParameters& parameters, ByteOrder order) {
  const auto value = [&](std::uint16_t id) -> const Bytes* {
    const auto found = parameters.find(id);
    return found == parameters.end() ? nullptr : &found->second;
  };
  if (vendor == fastdds_vendor) {
    if (const Bytes* octets = value(product_version)) return from_octets(*octets);
    return value(network_configuration_set) != nullptr ? "2.x from 2.12 on" : "2.x before 2.12";
  }
  if (vendor == cyclonedds_vendor) {
    const Bytes* info = value(cyclonedds_version_info);
    return info == nullptr ? "" : from_version_info(*info, order);
  }
  if (vendor == connext_vendor) {
    const Bytes* octets = value(product_version);
    return octets == nullptr ? "" : from_octets(*octets);
  }
  return "";
}

/// "2.12" of "2.x from 2.12 on" is found behind its word, and the hyphen of "fastdds-3.6" is no
/// sign.
std::optional<std::pair<unsigned, unsigned>> version_in(std::string_view text) {
  for (std::size_t at = 0; at < text.size(); ++at) {
    unsigned major = 0;
    unsigned minor = 0;
    const char* end = text.data() + text.size();
    const auto first = std::from_chars(text.data() + at, end, major);
    if (first.ec != std::errc{}) continue;
    if (first.ptr != end && *first.ptr == '.' &&
        std::from_chars(first.ptr + 1, end, minor).ec == std::errc{}) {
      return std::pair{major, minor};
    }
    at = static_cast<std::size_t>(first.ptr - text.data());
  }
  return std::nullopt;
}

}  // namespace stormproof::capture
