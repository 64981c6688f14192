// Reading of scenario files and profiles: the boundary at which everything that a user can get
// wrong is refused, with its place. What comes out is complete and within all ranges, and knows
// where each of its values came from.
#pragma once

#include <span>
#include <string>
#include <string_view>

#include "model/config/profile_files.hpp"
#include "model/config/spec_path.hpp"
#include "model/config/tree/result.hpp"
#include "model/config/tree/tree.hpp"
#include "model/config/vendor/vendor_profile.hpp"
#include "model/scenario.hpp"

namespace stormproof::model::config {

/// What was read, with all that is known of its origin.
template <class Value>
struct Traced {
  std::string reference;  ///< as the user gave it
  Value value;
  Places places;       ///< of the resolved tree: "spdp.period"; in a scenario "dds.spdp.period"
  std::string preset;  ///< the outermost shipped preset that the DDS profile builds on
                       ///< ("fastdds-2.6.11"): the first name in the chain of bases, or empty
  std::optional<vendor::VendorProfile> vendor;  ///< if the DDS profile is, or is based on, XML
};
using TracedProfile = Traced<DdsProfile>;

/// Reads a scenario. `reference` is a path (it has a '/' or ends in .yaml or .yml) or the name of a
/// file in specs/scenarios. Each override is "key.path=value", the value in YAML: a list element
/// goes by its number
/// ("wireless.stages.0.channel=x"), a profile can be replaced ("dds=NAME") or changed
/// ("dds.sedp.grouping=mtu"). Overrides that replace a profile or its base count before those of
/// single keys, otherwise they count in order.
[[nodiscard]] Result<Traced<Scenario>> trace_scenario(const std::string& reference,
                                                      std::span<const std::string> overrides,
                                                      const SpecPath& specs);
[[nodiscard]] Result<Scenario> read_scenario(const std::string& reference,
                                             std::span<const std::string> overrides,
                                             const SpecPath& specs);

/// The same for text that is already in memory, YAML or JSON; `source` is its name in errors, and
/// paths in it are relative to the folder of `source`.
[[nodiscard]] Result<Scenario> parse_scenario(std::string_view text, const std::string& source,
                                              std::span<const std::string> overrides,
                                              const SpecPath& specs);

/// Reads a profile by name or path (relative to the current directory); a DDS profile may be a
/// vendor's XML file ("robots.xml#lidar@fastdds-2.14.5", see vendor/reference.hpp). Overrides are
/// those of a scenario, without "dds." or "wireless." in front. With `Outside::admitted` also what
/// no run takes.
[[nodiscard]] Result<TracedProfile> trace_dds_profile(const std::string& reference,
                                                      std::span<const std::string> overrides,
                                                      const SpecPath& specs,
                                                      Outside outside = Outside::refused);
[[nodiscard]] Result<DdsProfile> read_dds_profile(const std::string& reference,
                                                  std::span<const std::string> overrides,
                                                  const SpecPath& specs);
[[nodiscard]] Result<WirelessProfile> read_wireless_profile(const std::string& reference,
                                                            std::span<const std::string> overrides,
                                                            const SpecPath& specs);

}  // namespace stormproof::model::config
