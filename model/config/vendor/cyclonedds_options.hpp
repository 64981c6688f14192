// The table of the settings that Cyclone DDS 0.10 knows: the values it takes, its defaults, and
// what each does to discovery and to its model. One table, so that the reader of the XML, its
// remarks about unknown names and the documentation cannot disagree.
#pragma once

#include <span>
#include <string_view>

#include "model/config/vendor/cyclonedds_values.hpp"
#include "model/config/vendor/vendor_profile.hpp"

namespace stormproof::model::config::vendor {

struct CycloneOption {
  std::string_view path;  ///< below Domain: "Internal/HeartbeatInterval[@min]"
  CycloneType type;
  std::string_view usual;        ///< its default, as the manual spells it; empty: none
  Effect effect = Effect::none;  ///< of a value that is not the default
  std::string_view note = {};    ///< what it does; after "VALUE; " if it is not modelled
  std::string_view knob = {};    ///< of the model
  bool always = false;           ///< the preset lists the default, too, among what is not modelled
  bool deprecated = false;       ///< 0.10 takes it with a warning
};

[[nodiscard]] std::span<const CycloneOption> cyclone_options();

/// Groups whose contents are not looked at, as far as 0.10 has them: their names, and what they do.
struct CycloneGroup {
  std::string_view path;
  Effect effect;
  std::string_view note;
};
[[nodiscard]] std::span<const CycloneGroup> cyclone_opaque_groups();

/// Names that 0.10 still takes: an old path, and what it means.
struct CycloneAlias {
  std::string_view old_path, path;
};
[[nodiscard]] std::span<const CycloneAlias> cyclone_aliases();

/// Elements and attributes of other versions that 0.10 refuses, and which versions those are.
struct CycloneForeign {
  std::string_view path, versions;
};
[[nodiscard]] std::span<const CycloneForeign> cyclone_foreign();

}  // namespace stormproof::model::config::vendor
