// Where every value of a profile came from. A report about a profile points at the line that a user
// wrote, and `profile show` tells a user's value from a preset's.
#pragma once

#include <map>
#include <optional>
#include <string>

#include "model/config/profile_files.hpp"
#include "model/config/scenario_file.hpp"
#include "model/config/tree/tree.hpp"
#include "model/config/vendor/vendor_profile.hpp"

namespace stormproof::model::config {

/// Places by dotted key: "spdp.period"; in a scenario "dds.spdp.period", "wireless.order", ….
/// Sections and list elements have places, too.
using Places = std::map<std::string, Place, std::less<>>;

/// Every node of `tree`, with `prefix` before its key.
[[nodiscard]] Places places_of(const Node& tree, const std::string& prefix = {});

/// A DDS profile, with all that is known of its origin.
struct TracedProfile {
  std::string reference;  ///< as the user gave it
  DdsProfile profile;
  Places places;
  std::string preset;  ///< the outermost shipped preset that it builds on ("fastdds-2.6.11"): the
                       ///< first name in the chain of bases; empty if there is none
  std::optional<vendor::VendorProfile> vendor;  ///< if it is, or is based on, vendor XML
};

/// As `read_dds_profile`. With `Outside::admitted` also what no run takes.
[[nodiscard]] Result<TracedProfile> trace_dds_profile(const std::string& reference,
                                                      std::span<const std::string> overrides,
                                                      const SpecPath& specs,
                                                      Outside outside = Outside::refused);

struct TracedScenario {
  Scenario scenario;
  Places places;
};

/// As `read_scenario`.
[[nodiscard]] Result<TracedScenario> trace_scenario(const std::string& reference,
                                                    std::span<const std::string> overrides,
                                                    const SpecPath& specs);

}  // namespace stormproof::model::config
