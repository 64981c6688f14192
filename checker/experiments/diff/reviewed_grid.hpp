// The deployments that two profiles are compared over: a grid of `sweep` whose DDS profile is
// replaced by each of the two, or one scenario as a grid of its own.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "model/config/spec_path.hpp"
#include "model/config/tree/result.hpp"
#include "model/scenario.hpp"

namespace stormproof::diff {

/// One deployment under both profiles.
struct ReviewedPoint {
  std::string name;  ///< what distinguishes it; the name of the grid if nothing does
  std::vector<std::pair<std::string, std::string>> values;  ///< swept key → value
  model::Scenario base, candidate;  ///< equal but for `dds`; neither has limits
  std::optional<model::Limits> limits;

  /// Whether its runs depend on drawn start times.
  [[nodiscard]] bool is_drawn() const { return base.deployment.schedule.has_value(); }
};

struct ReviewedGrid {
  std::string name;
  std::vector<ReviewedPoint> points;
  std::optional<std::size_t> samples;  ///< that the file asks for
  std::uint64_t first_seed = 0;
};

/// Descriptors to be delivered across hosts.
[[nodiscard]] std::uint64_t load_of(const ReviewedPoint& point);

/// `reference` is a path of a grid or scenario, or the name of a shipped one (grids first). Errors,
/// each with its place: what `read_grid` and `make_plan` refuse, a grid that sweeps `dds` or a key
/// of it, a combination that is no valid scenario with one of the profiles.
[[nodiscard]] model::config::Result<ReviewedGrid> read_reviewed_grid(
    const std::string& reference, const model::DdsProfile& base, const model::DdsProfile& candidate,
    const model::config::SpecPath& specs);

}  // namespace stormproof::diff
