// Variances of the strata's means add up.
#include "checker/experiments/statistics/stratified.hpp"

#include <algorithm>
#include <cmath>
#include <span>

#include <boost/math/distributions/students_t.hpp>

namespace stormproof::statistics {

namespace {

using Strata = std::vector<std::vector<double>>;

double mean_of(std::span<const double> values) {
  double sum = 0;
  for (const double value : values) sum += value;
  return sum / static_cast<double>(values.size());
}

double variance_of(std::span<const double> values) {
  const double mean = mean_of(values);
  double sum = 0;
  for (const double value : values) sum += (value - mean) * (value - mean);
  return sum / static_cast<double>(values.size() - 1);
}

/// Half of the interval of the mean over the strata.
double half_width(const Strata& strata, double confidence) {
  double variance = 0;
  double weighted = 0;  // squared parts over their degrees of freedom
  for (const std::vector<double>& stratum : strata) {
    const auto values = static_cast<double>(stratum.size());
    const double part = variance_of(stratum) / values;
    variance += part;
    weighted += part * part / (values - 1);
  }
  if (variance == 0) return 0;
  const boost::math::students_t t{variance * variance / weighted};
  return std::sqrt(variance) * boost::math::quantile(t, (1 + confidence) / 2) /
         static_cast<double>(strata.size());
}

bool all_finite(const Strata& strata) {
  return std::ranges::all_of(strata, [](const std::vector<double>& stratum) {
    return std::ranges::all_of(stratum, [](double value) { return std::isfinite(value); });
  });
}

double mean_of(const Strata& strata) {
  double sum = 0;
  for (const std::vector<double>& stratum : strata) sum += mean_of(std::span{stratum});
  return sum / static_cast<double>(strata.size());
}

}  // namespace

std::optional<MeanInterval> stratified_mean(const Strata& strata, double confidence) {
  if (!all_finite(strata)) return std::nullopt;
  const double estimate = mean_of(strata);
  const double half = half_width(strata, confidence);
  return MeanInterval{estimate, estimate - half, estimate + half};
}

std::optional<MeanInterval> stratified_ratio(const Strata& above, const Strata& below,
                                             double confidence) {
  if (!all_finite(above) || !all_finite(below)) return std::nullopt;
  const double mean_below = mean_of(below);
  if (mean_below == 0) return std::nullopt;
  const double ratio = mean_of(above) / mean_below;
  Strata residuals = above;
  for (std::size_t s = 0; s < above.size(); ++s) {
    for (std::size_t k = 0; k < above[s].size(); ++k) {
      residuals[s][k] = (above[s][k] - ratio * below[s][k]) / mean_below;
    }
  }
  const double half = half_width(residuals, confidence);
  return MeanInterval{ratio, ratio - half, ratio + half};
}

}  // namespace stormproof::statistics
