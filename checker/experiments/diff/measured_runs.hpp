// Runs of both profiles on the same schedules, as the numbers that are compared.
#pragma once

#include <array>
#include <cmath>
#include <cstdint>
#include <optional>
#include <vector>

#include "checker/engines/exact/health.hpp"
#include "checker/experiments/diff/diff.hpp"
#include "checker/experiments/diff/reviewed_grid.hpp"
#include "checker/experiments/trials/runner.hpp"

namespace stormproof::diff {

/// The values of one run, by `Measure`. The completion of a run that does not complete is infinite;
/// its other values are those of the run as far as it went.
using RunValues = std::array<double, common_measure_count>;

/// Pairs of runs of one deployment: run k of both sides has the k-th schedule.
struct PairedRuns {
  std::vector<RunValues> before, after;
  std::vector<exact::Health> health_before, health_after;
  bool identical = true;  ///< so far, every pair had the same result in every number
  /// Where runs of the deployment are cut, for lack of time: what is not complete by then takes at
  /// least that long, and its other values are those until then. Absent: they are not.
  std::optional<model::Nanoseconds> cut_at;

  [[nodiscard]] std::size_t size() const { return before.size(); }
  [[nodiscard]] bool is_cut(const RunValues& run) const {
    return cut_at && std::isinf(run[static_cast<std::size_t>(Measure::completion)]);
  }
  [[nodiscard]] static std::vector<double> column(const std::vector<RunValues>& runs,
                                                  Measure measure);
};

struct RunsWanted {
  std::size_t point = 0;    ///< in the grid
  std::size_t samples = 0;  ///< altogether: those that are there already count
};

/// Adds the missing runs to `runs`, which has one element for each point; all cores work on all
/// points, and the runner is told of pairs. Run k of a deployment has the schedule of seed
/// `first_seed` + k. Returns false if it was stopped: then points get all of their missing runs or
/// none.
[[nodiscard]] bool add_runs(const std::vector<ReviewedPoint>& points,
                            const std::vector<RunsWanted>& wanted, std::uint64_t first_seed,
                            trials::Runner& runner, std::vector<PairedRuns>& runs);

}  // namespace stormproof::diff
