// Quantiles with censored values.
#include "checker/experiments/statistics/quantiles.hpp"

#include <algorithm>

namespace stormproof::sampling {

Quantiles quantiles(std::vector<double> reached, std::size_t unreached) {
  std::sort(reached.begin(), reached.end());
  Quantiles result;
  result.count = reached.size() + unreached;
  if (result.count == 0) return result;
  const auto at = [&](double q) -> std::optional<double> {
    const double position = q * static_cast<double>(result.count - 1);
    const auto low = static_cast<std::size_t>(position);
    const double weight = position - static_cast<double>(low);
    const std::size_t high = weight > 0 ? low + 1 : low;
    if (high >= reached.size()) return std::nullopt;
    return reached[low] + weight * (reached[high] - reached[low]);
  };
  result.min = at(0);
  result.p10 = at(0.1);
  result.median = at(0.5);
  result.p90 = at(0.9);
  result.max = at(1);
  return result;
}

}  // namespace stormproof::sampling
