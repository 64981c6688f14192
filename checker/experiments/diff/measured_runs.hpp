// Runs of both profiles on the same schedules, as the numbers that are compared.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "checker/engines/exact/health.hpp"
#include "checker/experiments/diff/diff.hpp"
#include "checker/experiments/diff/reviewed_grid.hpp"
#include "checker/experiments/trials/runner.hpp"

namespace stormproof::diff {

/// The values of one run, by `Measure`. The completion of a run that does not complete is infinite;
/// its other values are those of the run as far as it went.
using RunValues = std::array<double, measure_count>;

/// Pairs of runs of one deployment: run k of both sides has the k-th schedule.
struct PairedRuns {
  std::vector<RunValues> before, after;
  std::vector<exact::Health> health_before, health_after;
  bool identical = true;  ///< so far, every pair had the same result in every number

  [[nodiscard]] std::size_t size() const { return before.size(); }
  [[nodiscard]] static std::vector<double> column(const std::vector<RunValues>& runs,
                                                  Measure measure);
};

struct RunsWanted {
  std::size_t point = 0;    ///< in the grid
  std::size_t samples = 0;  ///< altogether: those that are there already count
};

struct RunSettings {
  std::uint64_t first_seed = 0;  ///< run k of a deployment has the schedule of seed first_seed + k
  std::size_t threads = 0;       ///< 0: one for each core
  trials::Progress on_progress;  ///< told of pairs
};

/// Adds the missing runs to `runs`, which has one element for each point; all cores work on all
/// points. Returns false if it was stopped: then points get all of their missing runs or none.
[[nodiscard]] bool add_runs(const std::vector<ReviewedPoint>& points,
                            const std::vector<RunsWanted>& wanted, const RunSettings& settings,
                            std::vector<PairedRuns>& runs);

}  // namespace stormproof::diff
