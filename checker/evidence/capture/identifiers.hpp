// The names of participants and endpoints in RTPS, and which built-in endpoint is which (RTPS 2.5,
// sections 8.2.4 and 9.3): what the counting keys are made of.
#pragma once

#include <array>
#include <compare>
#include <cstdint>
#include <string>

#include "model/implementations.hpp"

namespace stormproof::capture {

/// The part of a GUID that a participant and all its endpoints share.
struct GuidPrefix {
  std::array<std::uint8_t, 12> bytes{};

  [[nodiscard]] bool is_unknown() const { return *this == GuidPrefix{}; }
  auto operator<=>(const GuidPrefix&) const = default;
};
/// "010f1c2d.a1b2c3d4.00000000".
[[nodiscard]] std::string to_string(const GuidPrefix& prefix);

/// Three bytes of key and one of kind, as one number: 0x000003c2 writes SEDP publications.
using EntityId = std::uint32_t;

namespace entity {
inline constexpr EntityId spdp_writer = 0x000100c2;
inline constexpr EntityId spdp_reader = 0x000100c7;
inline constexpr EntityId publications_writer = 0x000003c2;
inline constexpr EntityId publications_reader = 0x000003c7;
inline constexpr EntityId subscriptions_writer = 0x000004c2;
inline constexpr EntityId subscriptions_reader = 0x000004c7;
inline constexpr EntityId liveliness_writer = 0x000200c2;
// The TypeLookup service of XTypes 1.3: its readers have c4 in place of c3.
inline constexpr EntityId lookup_requests_writer = 0x000300c3;
inline constexpr EntityId lookup_replies_writer = 0x000301c3;
}  // namespace entity

struct Guid {
  GuidPrefix prefix{};
  EntityId entity = 0;

  auto operator<=>(const Guid&) const = default;
};

/// What a submessage belongs to, from its writer's entity id.
enum class Traffic : std::uint8_t {
  spdp,
  sedp,           ///< the reliable SEDP endpoints, publications and subscriptions
  liveliness,     ///< the writer liveliness protocol
  type_lookup,    ///< questions about types and their answers (XTypes 1.3, section 7.6.3.3)
  other_builtin,  ///< services of vendors, secure discovery, …
  user
};
inline constexpr std::array<Traffic, 6> all_traffic{Traffic::spdp,          Traffic::sedp,
                                                    Traffic::liveliness,    Traffic::type_lookup,
                                                    Traffic::other_builtin, Traffic::user};

[[nodiscard]] constexpr Traffic traffic_of(EntityId writer) {
  if (writer == entity::spdp_writer) return Traffic::spdp;
  if (writer == entity::publications_writer || writer == entity::subscriptions_writer) {
    return Traffic::sedp;
  }
  if (writer == entity::liveliness_writer) return Traffic::liveliness;
  if (writer == entity::lookup_requests_writer || writer == entity::lookup_replies_writer) {
    return Traffic::type_lookup;
  }
  return (writer & 0xc0U) == 0xc0U ? Traffic::other_builtin : Traffic::user;
}
[[nodiscard]] const char* name_of(Traffic traffic);

/// "pub" or "sub", the stream of an SEDP writer.
[[nodiscard]] const char* stream_of(EntityId sedp_writer);

/// The two bytes of a vendor, as one number.
using VendorId = std::uint16_t;
inline constexpr VendorId fastdds_vendor = model::vendor::fastdds;
/// "Fast DDS", "Cyclone DDS", …; "vendor 01.7f" if unknown.
[[nodiscard]] std::string vendor_name(VendorId vendor);

}  // namespace stormproof::capture
