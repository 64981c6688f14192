// Order statistics of a sample, for answers that are distributions.
#pragma once

#include <cstddef>
#include <optional>
#include <span>
#include <vector>

#include "checker/experiments/statistics/completion.hpp"

namespace stormproof::statistics {

/// Quantile q, from 0 to 1, of n > 0 values, not NaN: at position q·(n − 1) of the sorted values,
/// linearly interpolated. Between a finite value and an infinite one it is infinite; between −∞ and
/// +∞ nobody knows, so it is 0. `sorted` ascends.
[[nodiscard]] double quantile_of_sorted(std::span<const double> sorted, double q);
[[nodiscard]] double quantile(std::vector<double> values, double q);
[[nodiscard]] inline double median(std::vector<double> values) {
  return quantile(std::move(values), 0.5);
}

/// Median, 10–90 % range and extremes; of a run that did not complete as `completion.hpp` says: a
/// quantile that falls among unreached values does not exist.
struct Quantiles {
  std::size_t count = 0;  ///< runs, reached or not
  std::optional<double> min;
  std::optional<double> p10;
  std::optional<double> median;
  std::optional<double> p90;
  std::optional<double> max;  ///< absent if some run did not reach it
};

/// All absent if there are no values. `values` may be `unreached`.
[[nodiscard]] Quantiles quantiles(std::vector<double> values);

}  // namespace stormproof::statistics
