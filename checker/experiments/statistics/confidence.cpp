// The bounds are quantiles of beta distributions: low of Beta(k, n - k + 1), high of
// Beta(k + 1, n - k).
#include "checker/experiments/statistics/confidence.hpp"

#include <boost/math/special_functions/beta.hpp>

namespace stormproof::statistics {

RateInterval clopper_pearson(std::size_t hits, std::size_t runs, double level) {
  RateInterval interval;
  if (runs == 0) return interval;
  const double tail = (1 - level) / 2;
  const auto k = static_cast<double>(hits);
  const auto n = static_cast<double>(runs);
  if (hits > 0) interval.low = boost::math::ibeta_inv(k, n - k + 1, tail);
  if (hits < runs) interval.high = boost::math::ibeta_inv(k + 1, n - k, 1 - tail);
  return interval;
}

}  // namespace stormproof::statistics
