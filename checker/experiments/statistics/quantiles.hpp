// Order statistics of a sample, for predictions that are distributions.
#pragma once

#include <cstddef>
#include <optional>
#include <vector>

namespace stormproof::sampling {

/// Median, 10–90 % range and extremes. Values that a run did not reach (it did not complete) lie
/// above all others, so a quantile that falls among them does not exist.
struct Quantiles {
  std::size_t count = 0;  ///< runs, reached or not
  std::optional<double> min;
  std::optional<double> p10;
  std::optional<double> median;
  std::optional<double> p90;
  std::optional<double> max;  ///< absent if some run did not reach it
};

/// `reached` are the values, `unreached` is how many runs have none. Quantile q of n runs lies at
/// position q·(n − 1) of the sorted values, linearly interpolated.
[[nodiscard]] Quantiles quantiles(std::vector<double> reached, std::size_t unreached = 0);

}  // namespace stormproof::sampling
