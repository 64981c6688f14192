// The table of the settings that Cyclone DDS 0.10 and 11 know: the values they take, their
// defaults, and what each does to discovery and to its model. One table, so that the reader of the
// XML, its remarks about unknown names and the documentation cannot disagree.
#pragma once

#include <span>
#include <string_view>

#include "model/config/vendor/cyclonedds_values.hpp"
#include "model/config/vendor/vendor_profile.hpp"

namespace stormproof::model::config::vendor {

/// Versions of the library whose settings differ; what a base names decides.
enum class CycloneVersion : std::uint8_t { of_0_10, of_11 };
[[nodiscard]] CycloneVersion cyclone_version_of(std::string_view base);
/// "0.10".
[[nodiscard]] std::string_view print_version(CycloneVersion version);

/// Which of them have a setting.
enum class CycloneHas : std::uint8_t { both, only_0_10, from_11 };

struct CycloneOption {
  std::string_view path;  ///< below Domain: "Internal/HeartbeatInterval[@min]"
  CycloneType type;
  std::string_view usual;        ///< its default, as the manual spells it; empty: none
  Effect effect = Effect::none;  ///< of a value that is not the default
  std::string_view note = {};    ///< what it does; after "VALUE; " if it is not modelled
  std::string_view knob = {};    ///< of the model
  bool always = false;           ///< the preset lists the default, too, among what is not modelled
  bool deprecated = false;       ///< the library takes it with a warning
  CycloneHas versions = CycloneHas::both;
};

[[nodiscard]] std::span<const CycloneOption> cyclone_options(CycloneVersion version);

/// Groups whose contents are not looked at: their names, and what they do.
struct CycloneGroup {
  std::string_view path;
  Effect effect;
  std::string_view note;
  CycloneHas versions = CycloneHas::both;
};
[[nodiscard]] std::span<const CycloneGroup> cyclone_opaque_groups(CycloneVersion version);

/// Names that both still take: an old path, and what it means.
struct CycloneAlias {
  std::string_view old_path, path;
};
[[nodiscard]] std::span<const CycloneAlias> cyclone_aliases();

/// Elements and attributes of other versions, and which versions those are: that of the file
/// refuses what it does not have.
struct CycloneForeign {
  std::string_view path, versions;
};
[[nodiscard]] std::span<const CycloneForeign> cyclone_foreign();

}  // namespace stormproof::model::config::vendor
