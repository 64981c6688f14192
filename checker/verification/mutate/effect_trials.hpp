// The trials of mutants of effects: random runs of the mutant's composition, many of them with
// losses, late packets, late endpoints and returns. Their rules say what each event does
// (`composition.followed`), and a correct run what would have been.
#pragma once

#include <array>
#include <cstdint>
#include <functional>
#include <utility>
#include <vector>

#include "checker/verification/mutate/mutants.hpp"
#include "model/implementations.hpp"
#include "model/scenario.hpp"
#include "props/laws/run_log.hpp"

namespace stormproof::mutate {

class EffectTrials {
 public:
  static constexpr std::uint64_t runs = 120;

  /// `goes_on` is asked now and then; once it says no, what is returned means nothing.
  explicit EffectTrials(std::function<bool()> goes_on = {}) : goes_on_{std::move(goes_on)} {}

  /// Whether all runs of the mutant are what the rules say.
  [[nodiscard]] bool are_followed(const CatalogueEntry& entry);
  /// Whether some run of the mutant differs from the correct one: in an event, or in what one does.
  /// If none does, that is no proof.
  [[nodiscard]] bool makes_a_difference(const CatalogueEntry& entry);

 private:
  struct Correct {
    model::Scenario scenario;
    props::RunLog log;
  };
  /// The random scenarios of an implementation, and their correct runs.
  std::vector<Correct>& drawn(model::ImplementationKind implementation);

  [[nodiscard]] bool stopped() const { return goes_on_ && !goes_on_(); }

  std::function<bool()> goes_on_;
  std::array<std::vector<Correct>, model::implementation_traits.size()> drawn_;
};

}  // namespace stormproof::mutate
