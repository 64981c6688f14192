// Which laws (props/laws) notice a mutant: the share of the mutants that property tests find
// without knowing any property of the catalogue.
#pragma once

#include <array>
#include <functional>
#include <mutex>
#include <string>
#include <utility>
#include <vector>

#include "checker/verification/mutate/happened.hpp"
#include "checker/verification/mutate/mutants.hpp"
#include "checker/verification/mutate/trial_scenarios.hpp"
#include "model/implementations.hpp"
#include "props/laws/law.hpp"

namespace stormproof::mutate {

/// Whether a run can show the mutant at all. One in the order of events cannot: it is about the
/// comparison of events that the checker proves something about, not about the simulator's.
[[nodiscard]] bool shows_in_runs(const checker::Mutant& mutant);

/// May be shared by threads.
class LawTrials {
 public:
  /// `goes_on` is asked now and then; once it says no, what is returned means nothing.
  explicit LawTrials(std::function<bool()> goes_on = {}) : goes_on_{std::move(goes_on)} {}

  /// Ids of the laws that are broken with the mutant on one of the trial scenarios, and hold there
  /// without it; in the order of `props::laws()`.
  [[nodiscard]] std::vector<std::string> killers(const CatalogueEntry& entry);

 private:
  /// A law that applies to a scenario and holds there without a mutant.
  struct Kept {
    std::size_t law;    ///< in `props::laws()`
    Happened happened;  ///< in all runs that it looks at, without a mutant
  };
  struct Ground {
    Trial trial;
    std::vector<Kept> kept;
  };
  const std::vector<Ground>& grounds(model::ImplementationKind implementation);
  void ask(const Ground& ground, const CatalogueEntry& entry, std::vector<bool>& kills) const;
  [[nodiscard]] bool stopped() const { return goes_on_ && !goes_on_(); }

  std::function<bool()> goes_on_;
  std::mutex drawing_;
  std::array<std::vector<Ground>, model::implementation_traits.size()> grounds_;
};

}  // namespace stormproof::mutate
