// Profiles build on each other: `base:` names another profile whose keys are taken over unless they
// are given. A DDS vendor's XML file is such a profile, too: its base is the preset of a version of
// the vendor's library. This resolves a reference to a profile into one complete tree, in which
// every value still knows its own file.
#pragma once

#include <optional>
#include <string>

#include "model/config/spec_path.hpp"
#include "model/config/tree/tree.hpp"
#include "model/config/vendor/vendor_profile.hpp"

namespace stormproof::model::config {

/// Longest chain of profiles that build on each other.
inline constexpr std::size_t max_base_chain = 32;

/// A tree that needs no other file any more, and what its DDS profile was made of.
struct Resolved {
  Node tree;
  std::string preset{};  ///< the outermost file that has a name in `specs`; empty if there is none
  std::optional<vendor::VendorProfile> vendor{};  ///< the outermost vendor XML
};

/// Whether a vendor's file may say what the model cannot describe or the vendor's library refuses
/// (remarks with `Severity::error`): whoever runs the profile refuses that, whoever explains the
/// file takes it.
enum class Outside : std::uint8_t { refused, admitted };

/// The key of a profile file that lists the implementations its other keys are for. With another
/// one the profile is its base.
inline constexpr std::string_view only_with_key = "only_with";

/// `reference` is a name, a path (relative to the file in which it stands), a map, or, of a DDS
/// profile, a vendor's XML file as `vendor::parse_reference` takes it. Errors: no such profile, a
/// file that cannot be read, a profile that is based on itself, on one with another implementation
/// or on a preset of another vendor, and what `outside` refuses. `implementation` is the one that a
/// wireless profile is for, by name; empty: any.
[[nodiscard]] Result<Resolved> resolve_profile(Node reference, SpecKind kind, const SpecPath& specs,
                                               Outside outside = Outside::refused,
                                               std::string_view implementation = {});
/// The implementation that a resolved DDS profile says, by name.
[[nodiscard]] std::string_view implementation_of(const Node& dds);

/// An error if `replacement` is another implementation than that of `profile`, a resolved DDS
/// profile: implementations have different keys, so one cannot be changed into the other. A profile
/// that does not say its implementation has the paper's.
[[nodiscard]] std::optional<InputError> check_implementation(const Node& profile,
                                                             const Node* replacement);

/// Takes `description` out of `map`; an error if it is not text.
[[nodiscard]] std::optional<InputError> drop_description(Node& map);

}  // namespace stormproof::model::config
