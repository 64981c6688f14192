// Profiles build on each other: `base:` names another profile whose keys are taken over unless they
// are given. This resolves a reference to a profile into one complete tree, in which every value
// still knows its own file.
#pragma once

#include <string_view>

#include "model/config/spec_path.hpp"
#include "model/config/tree.hpp"

namespace stormproof::model::config {

/// Keys that every profile may have and that are gone once it is resolved.
inline constexpr std::string_view base_key = "base";
inline constexpr std::string_view description_key =
    "description";  ///< free text; scenarios have it, too

/// Longest chain of profiles that build on each other.
inline constexpr std::size_t max_base_chain = 32;

/// `reference` is a name, a path (relative to the file in which it stands), or a map. Errors: no
/// such profile, a file that cannot be read, a profile that is based on itself or on one with
/// another implementation.
[[nodiscard]] Result<Node> resolve_profile(Node reference, SpecKind kind, const SpecPath& specs);

/// An error if `replacement` is another implementation than that of `profile`, a resolved DDS
/// profile: implementations have different keys, so one cannot be changed into the other. A profile
/// that does not say its implementation has the paper's.
[[nodiscard]] std::optional<InputError> check_implementation(const Node& profile,
                                                             const Node* replacement);

/// Takes `description` out of `map`; an error if it is not text.
[[nodiscard]] std::optional<InputError> drop_description(Node& map);

}  // namespace stormproof::model::config
