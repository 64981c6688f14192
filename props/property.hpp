// The catalogue of properties. Ids are stable and part of the interface: scripts, reports and
// expected verdicts refer to them.
#pragma once

#include <array>
#include <optional>
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

/// What a property speaks of. It applies where there is that; where there is something else that it
/// can be said of, its entry has a `Wording`.
enum class Vocabulary : unsigned char {
  everything,   ///< machines, the order of events, the network, results: there always are
  rules,        ///< the effects of rules, whoever runs them
  descriptors,  ///< C and X of each descriptor of a relation, and what is scheduled for them
  closed_loop   ///< what only the rules of the closed-loop model have
};

/// What a property counts on besides the rules. Where it is not true, it says nothing.
enum class Premise : unsigned char {
  rules,           ///< nothing: it is about rules as such, whatever surrounds them
  services,        ///< a service takes time, and receptions are handled when they happen
  run,             ///< nothing that a run could lack; what engines prove is about what they know
  one_way,         ///< each packet goes one way from its source to all its receivers
  punctual_timers  ///< timers are served when they are due: bounds count from then
};

/// What has to happen in a deployment, or there is nothing to say.
enum class Need : unsigned char { nothing, failure, silence };

/// How a property is said of a writer that not all engines know.
struct Wording {
  std::vector<Engine> engines = {};  ///< which decide it there, besides runs
  std::string_view addition = {};    ///< what to add to the statement
};

struct Property {
  std::string_view id = {};           ///< "safety.snapshot"
  std::string_view statement = {};    ///< one sentence
  std::string_view formal = {};       ///< in symbols; D(ata), X, C as in specs/guide/model.md
  std::string_view stateful = {};     ///< what to add to it for a stateful writer; may be empty
  std::string_view assumptions = {};  ///< what it is claimed under; empty: nothing
  std::vector<Engine> engines = {};   ///< which can decide it
  std::string_view source = {};       ///< rule or section
  /// Why the paper's writer, or the stateful one, does not promise it: under which delays or losses
  /// it breaks. Empty if it is promised.
  std::string_view weakness = {};
  std::string_view stateful_weakness = {};
  /// It says how far a profile is from a failure. A run beyond that distance has not failed by it.
  bool is_margin = false;
  /// It says what a library does, whatever surrounds it: no deployment can mend it, and what a run
  /// shows of it is an answer about the profile.
  bool is_of_library = false;
  // Where it applies; asked for by `applicability_of` (props/applicability.hpp) only.
  Vocabulary about = Vocabulary::descriptors;
  std::optional<Wording> amended = {};  ///< of the amended rules of the closed-loop model
  std::optional<Wording> clients = {};  ///< of what clients tell a Discovery Server
  std::optional<Wording> relayed = {};  ///< of all that a Discovery Server and its clients do
  std::optional<Wording> samples = {};  ///< of a writer that numbers samples: Cyclone DDS's
  bool of_lives = false;  ///< also of participants of Fast DDS that forget and come back
  Premise counts_on = Premise::run;
  Need needs = Need::nothing;
};

/// All properties, in the order in which reports show them.
[[nodiscard]] std::span<const Property> catalogue();

/// What the property says about profiles of this implementation.
[[nodiscard]] std::string statement_of(const Property& property,
                                       model::ImplementationKind implementation);

/// The property of the catalogue, or the limit (props/limits.hpp), with this id; or null.
[[nodiscard]] const Property* find_property(std::string_view id);

}  // namespace stormproof::props
