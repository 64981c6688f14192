// The runs of a scenario by their completion, as a chart: the distribution is the answer, not one
// of its numbers.
#pragma once

#include <string>
#include <vector>

#include "checker/experiments/trials/sample_runs.hpp"

namespace stormproof::report {

/// How many runs are complete by when, a mark for each run in the colour of what it was; a run that
/// is not complete has a cross at `limit`. Empty if there are fewer than two.
[[nodiscard]] std::string distribution_plot(const std::vector<trials::Sample>& samples,
                                            model::Nanoseconds limit);

}  // namespace stormproof::report
