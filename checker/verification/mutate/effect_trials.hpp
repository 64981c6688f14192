// The trials of mutants of effects: random runs of the mutant's composition, many of them with
// losses, late packets, late endpoints and returns. Onlookers judge them from outside; the correct
// rules, executed beside them, say what each event should have done (`composition.followed`); and a
// correct run is what would have been.
#pragma once

#include <array>
#include <cstdint>
#include <functional>
#include <mutex>
#include <optional>
#include <utility>
#include <vector>

#include "checker/verification/mutate/happened.hpp"
#include "checker/verification/mutate/mutants.hpp"
#include "checker/verification/mutate/onlookers.hpp"
#include "model/implementations.hpp"
#include "model/scenario.hpp"
#include "props/laws/run_log.hpp"

namespace stormproof::mutate {

/// What a mistake changes for a user, in the worst of the runs.
enum class Harm : std::uint8_t {
  unseen,    ///< no event of any run differs, which proves nothing
  nothing,   ///< only what the machines remember, or the order of events at one instant
  time,      ///< when something is sent, or when discovery is complete
  messages,  ///< how many there are of a class
  discovery  ///< descriptors are missing in the end
};
inline constexpr std::array<std::string_view, 5> harm_names{"unseen", "nothing", "time", "messages",
                                                            "discovery"};
[[nodiscard]] constexpr std::string_view name_of(Harm harm) {
  return harm_names[static_cast<std::size_t>(harm)];
}

struct EffectFindings {
  /// Who of the onlookers objects to the first run that somebody objects to. If there is none:
  Ids objections;
  bool are_followed = true;  ///< whether all runs are what the rules say
  Harm harm = Harm::unseen;
};

/// May be shared by threads.
class EffectTrials {
 public:
  static constexpr std::uint64_t runs = 120;
  /// Of a mistake that nobody objects to: so many runs that differ are looked at.
  static constexpr std::uint64_t differing_runs = 80;

  /// `goes_on` is asked now and then; once it says no, what is returned means nothing.
  explicit EffectTrials(std::function<bool()> goes_on = {}) : goes_on_{std::move(goes_on)} {}

  [[nodiscard]] EffectFindings try_out(const CatalogueEntry& entry);

 private:
  struct Correct {
    model::Scenario scenario;
    props::RunLog log;
    model::RunResult result;
    Happened happened;
    Ids objections;  ///< without a mistake
  };
  struct Mistaken {
    props::RunLog log;
    model::RunResult result;
    std::optional<Ids> objections = {};  ///< if onlookers watched
  };
  static Mistaken run_with(const CatalogueEntry& entry, const Correct& correct, bool is_watched);
  /// The random scenarios of an implementation, and their correct runs, the shortest, the longest,
  /// and so on from both ends: most mistakes show themselves in short ones, some only in long ones.
  const std::vector<Correct>& drawn(model::ImplementationKind implementation);
  [[nodiscard]] bool stopped() const { return goes_on_ && !goes_on_(); }

  std::function<bool()> goes_on_;
  std::mutex drawing_;
  std::array<std::vector<Correct>, model::implementation_traits.size()> drawn_;
};

}  // namespace stormproof::mutate
