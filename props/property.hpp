// The catalogue of properties. Ids are stable and part of the interface: scripts, reports and
// expected verdicts refer to them.
#pragma once

#include <array>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "model/dds_profile.hpp"

namespace stormproof::props {

/// The ways to decide a property.
enum class Engine : unsigned char { tables, explorer, timelines, exact_run, calculus };

[[nodiscard]] const char* name_of(Engine engine);

/// What an answer about a property covers.
enum class Reach : unsigned char {
  deployment,  ///< the scenario as described: its channel, its load, its start times
  profile,     ///< every deployment with this profile, up to stated delays and losses
  rules        ///< the transition tables and their composition, whatever surrounds them
};
inline constexpr std::array reaches{Reach::deployment, Reach::profile, Reach::rules};
/// "deployment", "profile", "rules".
[[nodiscard]] const char* name_of(Reach reach);

struct Property {
  std::string_view id;           ///< "safety.snapshot"
  std::string_view statement;    ///< one sentence
  std::string_view formal;       ///< the same in symbols; D(ata), X, C as in specs/guide/model.md
  std::string_view stateful;     ///< what to add to it for a stateful writer; may be empty
  std::string_view assumptions;  ///< what it is claimed under; empty: nothing
  std::vector<Engine> engines;   ///< which can decide it
  std::string_view source;       ///< rule or section
  /// Why the paper's writer, or the stateful one, does not promise it: under which delays or losses
  /// it breaks. Empty if it is promised.
  std::string_view weakness = {};
  std::string_view stateful_weakness = {};
  /// It says how far a profile is from a failure. A run beyond that distance has not failed by it.
  bool is_margin = false;

  /// The weakness of these rules; empty: they promise the property.
  [[nodiscard]] std::string_view weakness_of(model::ImplementationKind implementation) const;
};

/// All properties, in the order in which reports show them.
[[nodiscard]] std::span<const Property> catalogue();

/// What is to be added to the statement for the writer of an implementation; mostly nothing.
[[nodiscard]] std::string_view addition_of(const Property& property,
                                           model::ImplementationKind implementation);

/// What the property says about profiles of this implementation.
[[nodiscard]] std::string statement_of(const Property& property,
                                       model::ImplementationKind implementation);

/// The property of the catalogue, or the limit (props/limits.hpp), with this id; or null.
[[nodiscard]] const Property* find_property(std::string_view id);

}  // namespace stormproof::props
