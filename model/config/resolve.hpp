// Everything of reading a scenario or a profile that comes before its values are looked at: the
// text as a tree, profiles with their bases, overrides. What comes out is the tree that the knob
// tables read, in which every value still knows where it was written.
#pragma once

#include <span>
#include <string>
#include <string_view>

#include "model/config/profile_files.hpp"
#include "model/config/spec_path.hpp"
#include "model/config/tree/tree.hpp"

namespace stormproof::model::config {

/// The scenario in `text`; `source` is its name in errors.
[[nodiscard]] Result<Node> resolve_scenario_text(std::string_view text, const std::string& source,
                                                 std::span<const std::string> overrides,
                                                 const SpecPath& specs);

/// The scenario that `reference` names.
[[nodiscard]] Result<Node> resolve_scenario(const std::string& reference,
                                            std::span<const std::string> overrides,
                                            const SpecPath& specs);

/// The profile that `reference` names; overrides without "dds." or "wireless." in front.
[[nodiscard]] Result<Node> resolve_profile(const std::string& reference, SpecKind kind,
                                           std::span<const std::string> overrides,
                                           const SpecPath& specs, ProfileOrigin* origin = nullptr,
                                           Outside outside = Outside::refused);

}  // namespace stormproof::model::config
