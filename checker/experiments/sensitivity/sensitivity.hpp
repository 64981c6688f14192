// Which knob matters: runs a scenario with every number a little smaller and a little greater, one
// at a time, and ranks them by what that does to completion and messages. Every change is run with
// the same seeds as the unchanged scenario and compared seed by seed, so that the chance of the
// start times cancels out as far as it can; a storm is chaotic, so it does not cancel completely.
#pragma once

#include <array>
#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "checker/experiments/sensitivity/levels.hpp"
#include "checker/experiments/statistics/measure.hpp"
#include "checker/experiments/statistics/paired.hpp"
#include "checker/experiments/trials/budget.hpp"
#include "checker/experiments/trials/runner.hpp"
#include "checker/experiments/trials/unasked.hpp"
#include "model/scenario.hpp"

namespace stormproof::sensitivity {

/// What a run costs.
using statistics::Measure;
inline constexpr std::array<Measure, 2> measures{Measure::completion, Measure::messages};

struct Options {
  double range = 0.2;                ///< relative step, greater than 0 and less than 1
  std::size_t samples = 1;           ///< runs of each change
  std::uint64_t first_seed = 0;      ///< of the start times of the first run; the next ones follow
  model::Nanoseconds start_jitter;   ///< each participant starts up to this much later
  Measure by = Measure::completion;  ///< what ranks the knobs
  std::size_t pairs_of = 0;  ///< the interactions of so many of the first knobs are looked at
  std::size_t threads = 0;   ///< 0: one for each core
  trials::Budget time;       ///< runs are made to fit
  trials::Progress on_progress;
};

/// The effect of a change: the median of the differences between runs with and without it, seed by
/// seed, and how sure it is.
struct Effect {
  double median = 0;  ///< infinite if most runs complete with one of them and not with the other
  double low = 0, high = 0;  ///< the interval; both are the median if there is one pair
  double confidence = 0;     ///< of the interval: at least 0.95 from six pairs on; 0 for one pair
  bool exactly_zero = true;  ///< no pair differs at all

  /// Whether the interval says in which direction the effect goes.
  [[nodiscard]] bool is_clear() const { return low > 0 || high < 0; }
  bool operator==(const Effect&) const = default;
};

/// Effects on both measures, in nanoseconds and messages.
using Effects = std::array<Effect, measures.size()>;
[[nodiscard]] inline const Effect& of(const Effects& effects, Measure measure) {
  return effects[static_cast<std::size_t>(measure)];
}

struct LevelResult {
  std::string value;
  Effects effects;
  std::size_t incomplete = 0;  ///< runs in which discovery does not complete
};

struct KnobResult {
  std::string key, value, doc;
  std::array<std::optional<LevelResult>, 2> levels;  ///< by direction
  std::string obstacle;

  /// The greater of its two effects, without sign; 0 if there is none.
  [[nodiscard]] double swing(Measure measure) const;
  /// Whether no run differs from its unchanged one in this.
  [[nodiscard]] bool is_without_effect(Measure measure) const;
};

/// Two knobs moved at once, each in the direction of its greater effect.
struct PairResult {
  std::array<std::string, 2> keys;
  std::array<Direction, 2> directions{};
  Effects joint;        ///< of both
  Effects interaction;  ///< joint less the sum of the single ones; 0: the effects just add up
};

struct Report {
  std::array<double, measures.size()>
      base{};                        ///< medians of the unchanged scenario; may be infinite
  std::size_t incomplete = 0;        ///< of its runs
  std::vector<KnobResult> knobs;     ///< those with a level, the greatest effect first
  std::vector<KnobResult> unvaried;  ///< those without
  std::vector<PairResult> pairs;     ///< the greatest interaction first
  std::size_t samples = 0;           ///< runs of each change that count
  std::size_t runs = 0;              ///< that finished
  trials::Unasked unasked;
  /// Simulated time that runs are cut at, where the unchanged scenario is not complete by then
  /// either; absent: none is.
  std::optional<model::Nanoseconds> cut_at;
  bool finished = true;  ///< false: stopped, so there are fewer samples, or changes are left out
};

/// `scenario` must be valid. With neither a schedule nor start jitter all samples are the same run.
[[nodiscard]] Report analyse(const model::Scenario& scenario, const Options& options);

}  // namespace stormproof::sensitivity
