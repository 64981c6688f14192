// The mean over strata of which each counts the same, each with its own variance, with the interval
// of Student's t; degrees of freedom are those of Welch and Satterthwaite (Cochran, "Sampling
// Techniques", section 5.4). It takes the sum of many runs to be about normal. Paired differences
// of single runs, whose tails are heavy, are for the sign test (paired.hpp).
#pragma once

#include <optional>
#include <vector>

namespace stormproof::statistics {

struct MeanInterval {
  double estimate = 0;
  double low = 0, high = 0;
};

/// At least one stratum, each of at least two values. Nothing if a value is infinite: then there is
/// no mean.
[[nodiscard]] std::optional<MeanInterval> stratified_mean(
    const std::vector<std::vector<double>>& strata, double confidence);

/// The quotient of two such means, value by value of the same runs: the linearised ratio estimator
/// (Cochran, section 6.11). Nothing if the mean below is 0, or there is none.
[[nodiscard]] std::optional<MeanInterval> stratified_ratio(
    const std::vector<std::vector<double>>& above, const std::vector<std::vector<double>>& below,
    double confidence);

}  // namespace stormproof::statistics
