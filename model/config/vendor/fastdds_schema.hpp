// The elements of a Fast DDS XML profile, as the parser of v2.6.11 takes them (XMLParser.cpp,
// XMLElementParser.cpp, fastRTPS_profiles.xsd): of which type each is, what its default is, and
// what it does to discovery. One table for each kind of profile; the reader knows no element but
// through it.
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <string_view>

#include "model/config/vendor/vendor_profile.hpp"
#include "model/dds_profile.hpp"

namespace stormproof::model::config::vendor::fastdds {

/// How the text of an element is read.
enum class ValueKind : std::uint8_t {
  group,  ///< has only elements of the table below it
  flag,   ///< true or false
  uint32,
  int32,
  uint16,
  uint8,
  duration,  ///< <sec> and <nanosec>, or DURATION_INFINITY
  choice,    ///< one of `choices`
  choices,   ///< some of `choices`, joined by '|'
  text,
  locators,    ///< <locator> elements
  addresses,   ///< <address> elements
  transports,  ///< <transport_id> elements
  properties,  ///< <properties> and <binary_properties>
  opaque       ///< nothing below it matters here
};

/// Version of the library in which an element appears, major·100 + minor.
using Version = int;
inline constexpr Version oldest_version = 206;
/// "2.6".
[[nodiscard]] std::string print_version(Version version);
/// Of a preset: "fastdds-2.14.5…" is 214; any other name is that of the default preset.
[[nodiscard]] Version version_of(std::string_view base);
/// Of what is announced.
[[nodiscard]] constexpr model::SizesSince sizes_in(Version version) {
  if (version < 302) return model::SizesSince::v2_6;
  return version < 306 ? model::SizesSince::v3_2 : model::SizesSince::v3_6;
}

/// Since when a <discoveryServersList> holds locators instead of servers with prefixes.
inline constexpr Version servers_by_address = 300;

/// Kinds of transport that read an element of a transport descriptor.
inline constexpr unsigned udp = 1, tcp = 2, shm = 4, any_transport = udp | tcp | shm;

// What several items say.
inline constexpr std::string_view port_note = "moves ports; no packet more or less";
inline constexpr std::string_view thread_note = "priority and stack of a thread";
inline constexpr std::string_view history_policies =
    "PREALLOCATED|PREALLOCATED_WITH_REALLOC|DYNAMIC|DYNAMIC_REUSABLE";

struct SchemaItem {
  std::string_view path;  ///< from the profile's element: "rtps/builtin/initialPeersList"
  ValueKind kind = ValueKind::opaque;
  std::string_view
      standard;  ///< the library's default, as `Setting::value` prints it; may be empty
  Effect effect = Effect::none;   ///< of any other value
  std::string_view note;          ///< of a value that is not the default
  std::string_view choices = {};  ///< of a choice, separated by '|'
  Version since = oldest_version;
  unsigned transports = any_transport;

  [[nodiscard]] std::string_view name() const { return path.substr(path.rfind('/') + 1); }
};

/// Below <participant>.
[[nodiscard]] std::span<const SchemaItem> participant_schema();
/// Below <transport_descriptor>.
[[nodiscard]] std::span<const SchemaItem> transport_schema();
/// Below <data_writer> (<publisher>) and <data_reader> (<subscriber>), without what is in their
/// quality of service.
[[nodiscard]] std::span<const SchemaItem> writer_schema();
[[nodiscard]] std::span<const SchemaItem> reader_schema();

/// Names of properties that Fast DDS reads, with what they do.
[[nodiscard]] std::span<const SchemaItem> property_schema();

/// The item with this path, or null.
[[nodiscard]] const SchemaItem* find_item(std::span<const SchemaItem> schema,
                                          std::string_view path);

/// Where in the files an element of this name (in any case) belongs: its path with the profile's
/// element in front, or nothing.
[[nodiscard]] std::optional<std::string> home_of(std::string_view name);

}  // namespace stormproof::model::config::vendor::fastdds
