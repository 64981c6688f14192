// Whose library is tuned: the scenario, the preset of the version of the library that its DDS
// profile describes, and so the vendor whose settings may be searched. The paper's profile is no
// product, and nobody can set anything in it.
#pragma once

#include <span>
#include <string>

#include "model/config/spec_path.hpp"
#include "model/config/tree/result.hpp"
#include "model/config/vendor/vendor_profile.hpp"
#include "model/scenario.hpp"

namespace stormproof::tune {

struct Subject {
  model::Scenario scenario;
  std::string preset;  ///< "fastdds-2.6.11": of a version, without settings of a user
  model::config::vendor::Vendor vendor{};
  model::DdsProfile base;  ///< what the preset says
};

/// A preset without the settings of a user: "fastdds-2.6.11-sndbuf4M" → "fastdds-2.6.11",
/// "fastdds-server-2.6.11" → the same.
[[nodiscard]] std::string version_of(const std::string& preset);

/// Reads a scenario as `read_scenario` does, and finds the preset of its DDS profile. `preset`, if
/// not empty, takes the place of that profile. Errors, in addition: a profile that is built on no
/// preset of a product, or has another implementation than its preset.
[[nodiscard]] model::config::Result<Subject> read_subject(const std::string& reference,
                                                          std::span<const std::string> overrides,
                                                          const std::string& preset,
                                                          const model::config::SpecPath& specs);

}  // namespace stormproof::tune
