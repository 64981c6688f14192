// What the search knows of a setting: the outcomes of its runs. The search never sees the model;
// it asks a function for the outcome of a setting under a seed, so that it can be tested on costs
// whose optimum is known.
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <map>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "checker/engines/exact/health.hpp"
#include "checker/experiments/trials/patience.hpp"
#include "checker/experiments/trials/runner.hpp"
#include "checker/experiments/tune/pareto.hpp"
#include "checker/experiments/tune/space.hpp"
#include "model/counts.hpp"
#include "model/units.hpp"

namespace stormproof::tune {

/// Of one run.
struct Outcome {
  std::optional<model::Nanoseconds> completion;  ///< absent: not complete within the limit
  double missing = 0;  ///< share of the descriptors that had not arrived then; 0 if complete
  /// When it was cut, if it was: `missing` and `counts` are those until then, and it takes longer.
  std::optional<model::Nanoseconds> cut;
  model::Counts counts;
  exact::RunHealth health{};
  std::vector<std::string_view> broken;  ///< ids of the properties and limits that must hold and
                                         ///< do not, ascending
  bool watched = false;                  ///< `broken` has what `Problem::watch` sees, too
};

/// What is searched: settings, whether one is a scenario at all, and the outcome of one under a
/// seed if a run may take `limit` of simulated time; nothing if it was interrupted. Called from
/// several threads. The same seed stands for the same circumstances whatever the setting is.
struct Problem {
  Space space;
  std::function<bool(const Point&)> is_valid;
  std::function<std::optional<Outcome>(const Point&, std::uint64_t seed, model::Nanoseconds limit)>
      run;
  /// What the same run breaks beside that, if it costs several times a run to see it: asked only of
  /// the settings that an answer rests on. Empty: nothing.
  std::function<std::optional<std::vector<std::string_view>>(const Point&, std::uint64_t seed,
                                                             model::Nanoseconds limit)>
      watch{};
};

/// Seeds first, first + 1, …
struct Seeds {
  std::uint64_t first = 0;
  std::size_t count = 1;
};

/// Medians over the runs.
[[nodiscard]] Cost cost_of(std::span<const Outcome> outcomes);

/// Ids that break in any of the runs, ascending.
[[nodiscard]] std::vector<std::string_view> broken_in(std::span<const Outcome> outcomes);

/// Every run that was made, so that none is made twice. With patience they are made in portions,
/// and what the settings of one take is what those of the next are cut by: the same on any number
/// of threads.
class Archive {
 public:
  /// `problem` and `runner` must outlive this.
  Archive(const Problem& problem, trials::Patience patience, trials::Runner& runner);

  /// Makes the runs that `points` lack under `seeds`; false if they were interrupted.
  bool extend(const std::vector<Point>& points, Seeds seeds);

  /// Has those runs of `points` watched that were made and are not yet; false if interrupted.
  bool watch(const std::vector<Point>& points, Seeds seeds);

  /// The outcomes of a point under those of `seeds` that were run, by seed.
  [[nodiscard]] std::vector<Outcome> outcomes(const Point& point, Seeds seeds) const;
  [[nodiscard]] Cost cost(const Point& point, Seeds seeds) const;
  /// Whether nothing breaks under `seeds`, as far as the runs were watched.
  [[nodiscard]] bool keeps(const Point& point, Seeds seeds) const;

  /// Runs that were made.
  [[nodiscard]] std::size_t runs() const { return runs_; }
  /// Settings of which at least one run is known.
  [[nodiscard]] std::size_t settings() const;
  /// Of the next run.
  [[nodiscard]] model::Nanoseconds limit() const { return patience_.limit(); }
  /// Runs that were cut.
  [[nodiscard]] std::size_t cuts() const { return cuts_; }
  /// From now on it has twice the patience, if nothing completed yet and there can be more; then
  /// runs that were cut are as if they had not been made.
  bool lengthen();
  /// Begins anew, with this patience.
  void begin_anew(trials::Patience patience);

 private:
  struct Job {
    const Point* point;
    std::uint64_t seed;
  };
  void run(std::span<const Job> jobs);

  const Problem& problem_;
  trials::Patience patience_;
  trials::Runner& runner_;
  std::size_t runs_ = 0, cuts_ = 0;
  std::map<Point, std::map<std::uint64_t, Outcome>> outcomes_;
};

}  // namespace stormproof::tune
