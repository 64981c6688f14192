// The costs of discovery with both profiles over a grid: runs as many schedules as the answer
// needs, judges them, and finds the storm-free margin.
#pragma once

#include <span>
#include <vector>

#include "checker/experiments/diff/judging.hpp"
#include "checker/experiments/diff/measured_runs.hpp"
#include "checker/experiments/trials/unasked.hpp"

namespace stormproof::diff {

struct CostRequest {
  const ReviewedGrid& grid;
  const Policy& policy;
  std::size_t samples = 1;       ///< schedules of each deployment at first
  std::size_t most_samples = 1;  ///< of a deployment that fewer leave unclear
  std::uint64_t first_seed = 0;
  trials::Runner& runner;
  trials::Budget time;  ///< pairs are made to fit
};

struct CostAnswer {
  CostComparison comparison;
  std::vector<PairedRuns> runs;  ///< of each deployment of the grid; none if it was interrupted
  trials::Unasked unasked;
  bool interrupted = false;
};

/// Deployments without drawn start times run once: their runs are facts. The others start with
/// `samples` schedules; those that stay unclear get twice as many, up to `most_samples`, if there
/// is time. Where there is none for the first ones, runs are cut, and then there are fewer.
[[nodiscard]] CostAnswer compare_costs(const CostRequest& request);

/// The storm-free margin of both profiles, over the deployments of a grid: the threshold of the
/// theorem where it is about all of them.
[[nodiscard]] MarginComparison compare_margins(const model::DdsProfile& base,
                                               const model::DdsProfile& candidate,
                                               std::span<const ReviewedPoint> points,
                                               const CostComparison& costs, const Policy& policy);

}  // namespace stormproof::diff
