// The engine of `stormproof fuzz`: runs many variants of a scenario, each drawn from the ranges
// around it, and judges each by properties and by the scenario's own limits. The answer is a
// sample: rates with confidence intervals, and for everything that broke a small counterexample.
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "checker/experiments/fuzz/judged_run.hpp"
#include "checker/experiments/fuzz/ranges.hpp"
#include "checker/experiments/fuzz/shrink.hpp"
#include "checker/experiments/statistics/confidence.hpp"
#include "checker/experiments/statistics/quantiles.hpp"
#include "props/verdict.hpp"

namespace stormproof::fuzz {

struct FuzzProgress {
  std::size_t finished = 0;    ///< runs
  std::size_t violating = 0;   ///< of them, those that break anything
  std::string_view shrinking;  ///< id of what is being shrunk; empty while variants run
};

struct FuzzOptions {
  std::size_t runs = 200;
  std::optional<double> seconds;  ///< no run starts later than this; absent: no such limit
  std::uint64_t seed = 0;
  std::uint64_t first = 0;  ///< number of the first variant
  std::size_t jobs = 0;     ///< threads; 0: one for each core. The answer does not depend on it
  /// Ids to judge by; empty: all properties that an ordinary run can show, and all limits.
  std::vector<std::string> only;
  /// Called from one thread at a time; false stops everything.
  std::function<bool(const FuzzProgress&)> on_progress;
};

/// The answer about one property or limit.
struct Judgment {
  std::string_view id;
  std::string statement;
  props::VerdictKind verdict = props::VerdictKind::inconclusive;
  std::optional<Breach> in_base;  ///< how the unperturbed scenario breaks it
  /// Whether variants were judged by it. A property that breaks without variation is left out
  /// unless it was asked for by id.
  bool sampled = true;
  /// Watched in some of the runs only (`is_watched`): the rules promise it, and nobody asked.
  bool promised = false;
  std::size_t runs = 0;    ///< that say something about it
  std::size_t broken = 0;  ///< of them
  statistics::RateInterval rate;
  std::uint64_t first_broken = 0;  ///< number of the first variant that breaks it
  std::string first_reason;
  std::optional<Shrunk> shrunk;
};

/// Whether what the rules promise is watched in the k-th run, from 0. Properties take several times
/// as long as a run, and those that are promised tell of the program rather than of the scenario.
/// The choice does not look at any run, so those that are watched are a sample as all runs are.
inline constexpr std::size_t watched_first = 20;
inline constexpr std::size_t watched_each = 20;
[[nodiscard]] constexpr bool is_watched(std::size_t k) {
  return k < watched_first || k % watched_each == 0;
}

struct FuzzReport {
  Ranges ranges;
  std::uint64_t seed = 0, first = 0;
  std::size_t wanted = 0;  ///< runs
  bool interrupted = false;
  bool undrawable = false;      ///< the ranges hardly contain a valid scenario
  JudgedRun base;               ///< the unperturbed run
  bool base_known = false;      ///< it finished
  std::vector<JudgedRun> runs;  ///< variants first, first + 1, …
  std::vector<Judgment> judgments;
  std::uint64_t rejected = 0;
  std::size_t incomplete = 0;  ///< runs in which discovery was not complete at the time limit
  statistics::Quantiles completion_ns, messages, amplification, backlog;

  [[nodiscard]] bool violated() const;
};

/// `scenario` is valid; its limits are those to judge by.
[[nodiscard]] FuzzReport fuzz(const model::Scenario& scenario, const Ranges& ranges,
                              const FuzzOptions& options);

}  // namespace stormproof::fuzz
