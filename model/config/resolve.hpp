// The middle of reading a scenario or a profile: overrides and profiles with their bases are put
// into the tree of its text. What comes out is the tree that the knob tables read, in which every
// value still knows where it was written.
#pragma once

#include <span>

#include "model/config/profile_files.hpp"
#include "model/config/spec_path.hpp"
#include "model/config/tree/overrides.hpp"

namespace stormproof::model::config {

using Overrides = std::span<const Override>;

/// Whether `path`, of a scenario, is a key of a resolved profile: an override of it has to wait
/// until the profile, or its base, has been chosen.
[[nodiscard]] bool is_profile_key(std::string_view path);

/// First the overrides that choose profiles (and those outside of profiles), then the profiles that
/// are chosen. `scenario` may be a part of one; if it is one without a DDS profile,
/// `implementation` is that of the whole, by name.
[[nodiscard]] Result<Resolved> with_profiles(Node scenario, Overrides overrides,
                                             const SpecPath& specs,
                                             std::string_view implementation = {});

/// The shipped preset of the same version that discovers that way ("fastdds-2.6.11" and "server":
/// "fastdds-server-2.6.11"); nothing if there is none, or it is one of a way itself.
[[nodiscard]] std::optional<std::string> preset_with(const std::string& preset,
                                                     std::string_view way, const SpecPath& specs);

/// Then the overrides of profile keys. Whoever chooses a Discovery Server over a preset without one
/// has, where he says nothing, what the preset of the same version with one says.
[[nodiscard]] Result<Resolved> with_profile_keys(Result<Resolved> scenario, Overrides overrides,
                                                 const SpecPath& specs);

/// The same for a profile alone, in which every override is of one of its keys, without "dds." or
/// "wireless." in front.
[[nodiscard]] Result<Resolved> with_keys(Result<Resolved> profile, SpecKind kind,
                                         Overrides overrides, const SpecPath& specs);

}  // namespace stormproof::model::config
