// A rolling upgrade: the fleets between the first upgraded host and the last, each a deployment
// whose upgraded hosts run the candidate, compared with the fleet as it was. What all of them cost
// says which order of hosts is the best, and which the worst. specs/guide/diff.md, "A rolling
// upgrade".
#pragma once

#include "checker/experiments/diff/diff.hpp"
#include "checker/experiments/diff/reviewed_grid.hpp"
#include "model/config/tree/result.hpp"

namespace stormproof::diff {

/// Hosts that do not differ in what they carry and how they are attached: which of them is upgraded
/// is the same.
struct AlikeHosts {
  std::vector<std::uint32_t> hosts;  ///< ascending; they are upgraded in this order
  std::string name;                  ///< of the first
};

/// The fleets that an upgrade of one deployment passes through, as points of a grid.
struct Stages {
  std::string fleet;
  std::vector<AlikeHosts> kinds;
  std::size_t first_point = 0;
  /// How many hosts of each kind are upgraded; the last one is all of them.
  std::vector<std::vector<std::uint32_t>> upgraded;
};

struct RollingGrid {
  ReviewedGrid grid;  ///< of all stages of all deployments
  std::vector<Stages> stages;
};

/// Most fleets between two profiles that are looked at.
inline constexpr std::size_t most_stages = 256;

/// Errors: profiles that cannot run beside each other, a deployment with profiles of its own, and
/// hosts so different that there are more fleets than `most_stages`.
[[nodiscard]] model::config::Result<RollingGrid> rolling_grid(const ReviewedGrid& grid);

/// The orders whose worst fleet is the least and the most bad: by its median completion, then by
/// its messages, then by the fleets before. Nothing if some fleet was not looked at.
[[nodiscard]] std::vector<Rollout> rollouts(const RollingGrid& rolling,
                                            const CostComparison& costs);

}  // namespace stormproof::diff
