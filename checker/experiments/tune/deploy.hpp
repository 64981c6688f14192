// A setting as what a user deploys: the vendor's XML, and what the machine must allow for it to
// take effect.
#pragma once

#include <string>
#include <vector>

#include "checker/experiments/tune/subject.hpp"

namespace stormproof::tune {

/// The file, ready to deploy, that makes the library behave like `profile`, with `comment` at its
/// top. It has been read back, and gives exactly this profile; otherwise, and if no user can set
/// it, an error.
[[nodiscard]] model::config::Result<std::string> deployable(const Subject& subject,
                                                            const model::DdsProfile& profile,
                                                            const std::string& comment,
                                                            const model::config::SpecPath& specs);

/// The profile that a vendor's XML text gives on top of `preset`.
[[nodiscard]] model::config::Result<model::DdsProfile> read_back(
    const std::string& xml, const std::string& preset, const model::config::SpecPath& specs);

/// What has to be done beside the file, one sentence each.
[[nodiscard]] std::vector<std::string> prerequisites(const Subject& subject,
                                                     const model::DdsProfile& profile);

/// The lines of a shell that make ROS 2 nodes read the file, which is in the current folder.
[[nodiscard]] std::vector<std::string> how_to_load(model::config::vendor::Vendor vendor,
                                                   const std::string& file);

/// "FILE.xml", or "FILE.xml@PRESET" where the reader would take another version for granted.
[[nodiscard]] std::string reference_to(const std::string& file, const Subject& subject);

}  // namespace stormproof::tune
