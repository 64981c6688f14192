// The number of differences below the true median is binomial with probability 1/2. So the interval
// from the k-th least to the k-th greatest of n differences misses it with probability
// 2·P(B < k).
#include "checker/experiments/statistics/paired.hpp"

#include <algorithm>
#include <cmath>

#include <boost/math/special_functions/beta.hpp>

#include "checker/experiments/statistics/quantiles.hpp"

namespace stormproof::statistics {

namespace {

/// The `rank`-th least, from 1.
double order_statistic(std::vector<double> values, std::size_t rank) {
  const auto place = values.begin() + static_cast<std::ptrdiff_t>(rank - 1);
  std::nth_element(values.begin(), place, values.end());
  return *place;
}

}  // namespace

IntervalRank sign_interval(std::size_t n, double confidence) {
  // P(B < k) = P(B ≤ k − 1) = I_{1/2}(n − k + 1, k).
  const auto below = [n](std::size_t k) {
    return boost::math::ibeta(static_cast<double>(n - k + 1), static_cast<double>(k), 0.5);
  };
  IntervalRank result{1, std::max(0.0, 1 - 2 * below(1))};
  for (std::size_t k = 2; 2 * k <= n + 1; ++k) {
    const double tail = below(k);
    if (tail > (1 - confidence) / 2) break;
    result = {k, 1 - 2 * tail};
  }
  return result;
}

std::size_t fewest_pairs(double confidence) {
  std::size_t n = 1;
  while (sign_interval(n, confidence).confidence < confidence) ++n;
  return n;
}

double relative_change(double before, double after) {
  if (before == 0 && after == 0) return 0;
  return after / before - 1;
}

void PairedDifferences::add(double difference, double least) {
  const bool unknown = std::isnan(difference);
  low_.push_back(unknown ? least : difference);
  high_.push_back(unknown ? std::numeric_limits<double>::infinity() : difference);
  middle_.push_back(unknown ? 0 : difference);
}

void PairedDifferences::add_between(double low, double high) {
  low_.push_back(low);
  high_.push_back(high);
  middle_.push_back(std::clamp(0.0, low, high));
}

bool PairedDifferences::all_zero() const {
  const auto is_zero = [](double value) { return value == 0; };
  return std::ranges::all_of(low_, is_zero) && std::ranges::all_of(high_, is_zero);
}

Shift PairedDifferences::shift(double confidence) const {
  const IntervalRank interval = sign_interval(size(), confidence);
  return {median(middle_), order_statistic(low_, interval.rank),
          order_statistic(high_, size() + 1 - interval.rank), interval.confidence};
}

Shift PairedDifferences::fact() const {
  return {middle_.front(), low_.front(), high_.front(), 1, true};
}

}  // namespace stormproof::statistics
