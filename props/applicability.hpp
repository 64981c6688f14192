// What can be said of a property about an implementation or a scenario: whether it applies, which
// engines may decide it, whether the rules promise it. It follows from what the property speaks of
// and counts on (its entry in the catalogue) and from what the composition and the scenario have.
// Verdicts, frontiers, margins, mutants, watched runs and lists ask this and nothing else.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "model/scenario.hpp"
#include "props/property.hpp"

namespace stormproof::props {

struct Applicability {
  /// Why it says nothing of the scenario, as a clause; empty: it applies.
  std::string_view why_not = {};
  /// Why what engines prove of it would say nothing of this scenario, as a sentence; empty if it
  /// would. They know rules that run at once when a timer is due, packets that take one way or are
  /// lost by number: not participants that stall or whose threads are busy, listed hosts, or
  /// transmissions that fail. Then only what is about the machines and the composition as such is
  /// proved; all else is observed.
  std::string_view why_not_provable = {};
  /// Why the rules do not promise it; empty: they do.
  std::string_view weakness = {};
  /// What is to be added to its statement for this writer; mostly nothing.
  std::string_view addition = {};
  /// Whether it is about what clients tell a Discovery Server, not about what the server relays.
  bool is_about_clients = false;
  /// Those that know how to decide it for this writer; `exact_run` if runs show it.
  std::vector<Engine> engines = {};

  [[nodiscard]] bool applies() const { return why_not.empty(); }
  [[nodiscard]] bool is_promised() const { return weakness.empty(); }
  /// "does not apply to this composition: " and why, for one that does not.
  [[nodiscard]] std::string in_words() const {
    return "does not apply to this composition: " + std::string{why_not};
  }
  /// Whether this engine is to be asked.
  [[nodiscard]] bool is_decided_by(Engine engine) const;
};

/// About runs of the scenario.
[[nodiscard]] Applicability applicability_of(const Property& property,
                                             const model::Scenario& scenario);
/// About an implementation, in scenarios that lack nothing of what the property counts on.
[[nodiscard]] Applicability applicability_of(const Property& property,
                                             model::ImplementationKind implementation);
/// The same of a property of the catalogue, or a limit, by its id.
[[nodiscard]] Applicability applicability_of(std::string_view property,
                                             const model::Scenario& scenario);

/// Why nobody can look for another DDS profile of the scenario: its participants do not have one.
/// Empty if they do.
[[nodiscard]] std::string_view why_profile_is_not_changed(const model::Scenario& scenario);

}  // namespace stormproof::props
