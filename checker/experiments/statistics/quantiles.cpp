// One interpolation for all of them.
#include "checker/experiments/statistics/quantiles.hpp"

#include <algorithm>
#include <cmath>

namespace stormproof::statistics {

double quantile_of_sorted(std::span<const double> sorted, double q) {
  const double position = q * static_cast<double>(sorted.size() - 1);
  const auto low = static_cast<std::size_t>(position);
  const double weight = position - static_cast<double>(low);
  if (weight == 0) return sorted[low];
  const double below = sorted[low];
  const double above = sorted[low + 1];
  if (std::isinf(below) || std::isinf(above)) return below == -above ? 0 : below + above;
  return below + weight * (above - below);
}

double quantile(std::vector<double> values, double q) {
  std::ranges::sort(values);
  return quantile_of_sorted(values, q);
}

Quantiles quantiles(std::vector<double> values) {
  Quantiles result;
  result.count = values.size();
  if (values.empty()) return result;
  std::ranges::sort(values);
  const auto at = [&values](double q) {
    const double value = quantile_of_sorted(values, q);
    return std::isinf(value) ? std::nullopt : std::optional{value};
  };
  result.min = at(0);
  result.p10 = at(0.1);
  result.median = at(0.5);
  result.p90 = at(0.9);
  result.max = at(1);
  return result;
}

}  // namespace stormproof::statistics
