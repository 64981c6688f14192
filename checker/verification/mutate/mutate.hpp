// `stormproof mutate` without its command line: runs the checks against every mutant and says which
// property and which law notices which.
#pragma once

#include <functional>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "checker/engines/smt/claims.hpp"
#include "checker/verification/mutate/effect_trials.hpp"
#include "checker/verification/mutate/mutants.hpp"

namespace stormproof::mutate {

struct MutantResult {
  std::string id;
  Kind kind = Kind::table;
  std::string description;
  /// Property ids, in the order of the catalogue; unless everybody was asked, those of the first
  /// engine on the first scenario that notices anything.
  std::vector<std::string> killed_by;
  std::string reason;  ///< of a survivor: why no property noticed it
  /// Laws that the mutant breaks; absent if no run can show it, or if they were not asked: a
  /// property has noticed it before.
  std::optional<std::vector<std::string>> killed_by_laws;
  /// Of a mutant of an effect that nobody notices, or only who executes the correct rules beside
  /// it: what it changes in random runs.
  std::optional<Harm> harm = {};

  /// By a property; a mistake at an effect also by a law.
  [[nodiscard]] bool noticed() const;
  /// The same if the mistake is in the rules that everybody reads, and not in a run that departs
  /// from them: by somebody else than `composition.followed`, which executes the rules.
  [[nodiscard]] bool noticed_in_rules() const;
  /// Whether no random run differs from the correct one.
  [[nodiscard]] bool unseen() const { return !noticed() && harm == Harm::unseen; }
};

/// Of the mistakes at effects of one composition: how many some run shows, and how many of these
/// are noticed if the mistake is in the rules themselves.
struct Share {
  std::string composition;
  std::size_t seen = 0;
  std::size_t noticed = 0;
  /// Laws and engines know its writer: 60 % are expected to be noticed.
  bool is_expected = false;

  [[nodiscard]] bool suffices() const;
};

struct MutationReport {
  std::vector<MutantResult> mutants;
  bool everybody = false;  ///< all properties and laws were asked
  double seconds = 0;
  bool interrupted = false;

  [[nodiscard]] std::size_t killed() const;
  /// Of how many no random run shows a difference. Nobody has proved that there is none.
  [[nodiscard]] std::size_t unseen() const;
  /// By composition, in the order of the mutants.
  [[nodiscard]] std::vector<Share> shares() const;
  /// Of all compositions together.
  [[nodiscard]] std::size_t seen_at_effects() const;
  [[nodiscard]] std::size_t noticed_in_rules() const;
  /// How many only `composition.followed` notices, which executes the correct rules beside a run.
  [[nodiscard]] std::size_t only_followed() const;
  /// At least 95 % of those that some run shows, or a proof; and each share suffices.
  [[nodiscard]] bool notices_enough() const;
  /// How many mutants the property notices.
  [[nodiscard]] std::size_t killed_by(std::string_view property) const;
  /// How many mutants at least one law notices, and on how many the laws were tried.
  [[nodiscard]] std::size_t killed_by_laws() const;
  [[nodiscard]] std::size_t tried_on_laws() const;
  /// How many mutants the law notices.
  [[nodiscard]] std::size_t killed_by_law(std::string_view law) const;
};

struct MutateOptions {
  std::vector<std::string> only;  ///< ids of mutants; empty: all
  std::vector<Kind> kinds;        ///< where the mistake is; empty: anywhere
  bool everybody = false;         ///< asks all, not only until somebody notices
  unsigned readers = 1;           ///< of one writer that the explorer looks at together, at most
  smt::Options solver;            ///< the second solver is not asked
  std::function<bool(std::string_view)> on_progress;
};

/// A property kills a mutant if it is violated with the mutant and not without, on one of a few
/// small scenarios of each implementation. A law does if it is broken with the mutant and not
/// without. `composition.live` and `composition.pending` are asked of mutants that forget events
/// only. It is asked whether somebody notices a mutant, cheap engines first; who else would, only
/// if everybody is to be asked, and never of the many mutants of effects.
[[nodiscard]] MutationReport mutate(const MutateOptions& options);

}  // namespace stormproof::mutate
