// The costs of two profiles over a grid of deployments, as plots: a reader sees at which load they
// part, and whether the ranges overlap.
#pragma once

#include <string>
#include <vector>

#include "checker/experiments/diff/diff.hpp"

namespace stormproof::diff {

/// SVG documents: the measure over the load, then over the last swept key for each value of the
/// others, if that are at most six plots. Median, and 10–90 % as a band. Runs that do not complete
/// are gaps. Empty without configurations.
[[nodiscard]] std::vector<std::string> measure_plots(const CostComparison& costs, Measure measure);

/// Messages by class at one configuration, as bars.
[[nodiscard]] std::string classes_plot(const Configuration& configuration);

/// The configurations that are worth a look at their messages: that with the highest load, and that
/// whose messages changed most.
[[nodiscard]] std::vector<const Configuration*> notable(const CostComparison& costs);

}  // namespace stormproof::diff
