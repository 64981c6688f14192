// Exact null distributions by their recursions, and the order statistics that they point at.
#include "checker/experiments/diff/shift.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <tuple>

#include <boost/math/special_functions/beta.hpp>
#include <boost/math/special_functions/erf.hpp>

namespace stormproof::diff {

namespace {

constexpr double unbounded = std::numeric_limits<double>::infinity();

/// P(W = w) for w = 0 … m·n. Either the greatest of all m + n values is one of the m, and exceeds
/// all n others, or it is one of the n:
///   P_{m,n}(w) = m/(m+n) · P_{m−1,n}(w − n) + n/(m+n) · P_{m,n−1}(w).
std::vector<double> rank_sum_distribution(std::size_t m, std::size_t n) {
  std::vector<std::vector<double>> row(n + 1, std::vector<double>{1.0});  // m = 0
  for (std::size_t i = 1; i <= m; ++i) {
    std::vector<std::vector<double>> next(n + 1);
    next[0] = {1.0};
    for (std::size_t j = 1; j <= n; ++j) {
      std::vector<double>& here = next[j];
      here.assign(i * j + 1, 0.0);
      const double total = static_cast<double>(i + j);
      for (std::size_t w = 0; w < row[j].size(); ++w) {
        here[w + j] += static_cast<double>(i) / total * row[j][w];
      }
      for (std::size_t w = 0; w < next[j - 1].size(); ++w) {
        here[w] += static_cast<double>(j) / total * next[j - 1][w];
      }
    }
    row = std::move(next);
  }
  return row[n];
}

/// z with P(Z > z) = tail, Z standard normal.
double upper_normal(double tail) { return std::sqrt(2.0) * boost::math::erfc_inv(2 * tail); }

/// P(Z ≤ z).
double normal(double z) { return std::erfc(-z / std::sqrt(2.0)) / 2; }

IntervalRank approximate_rank_sum(std::size_t m, std::size_t n, double confidence) {
  const double a = static_cast<double>(m);
  const double b = static_cast<double>(n);
  const double deviation = std::sqrt(a * b * (a + b + 1) / 12);
  const double rank = std::floor(a * b / 2 - upper_normal((1 - confidence) / 2) * deviation);
  IntervalRank result;
  result.rank = rank < 1 ? 1 : static_cast<std::size_t>(rank);
  result.confidence = 1 - 2 * normal((static_cast<double>(result.rank) - a * b / 2) / deviation);
  return result;
}

/// The `rank`-th smallest and greatest.
std::pair<double, double> ends(std::vector<double>& low, std::vector<double>& high,
                               std::size_t rank) {
  const auto lower = low.begin() + static_cast<std::ptrdiff_t>(rank - 1);
  const auto upper = high.begin() + static_cast<std::ptrdiff_t>(high.size() - rank);
  std::nth_element(low.begin(), lower, low.end());
  std::nth_element(high.begin(), upper, high.end());
  return {*lower, *upper};
}

/// Of a not empty list.
double median(std::vector<double> values) {
  const std::size_t half = values.size() / 2;
  const auto middle = values.begin() + static_cast<std::ptrdiff_t>(half);
  std::nth_element(values.begin(), middle, values.end());
  if (values.size() % 2 == 1) return *middle;
  const double above = *middle;
  const double below = *std::max_element(values.begin(), middle);
  if (!std::isinf(below) && !std::isinf(above)) return below + (above - below) / 2;
  return below == -above ? 0 : below + above;  // −infinity and +infinity: nobody knows
}

}  // namespace

double relative_change(double before, double after) {
  if (std::isinf(before)) return -1;
  if (before > 0) return after / before - 1;
  return after > 0 ? unbounded : 0;
}

void PairwiseChanges::add(double before, double after, bool relative) {
  const bool unknown = std::isinf(after) && std::isinf(before);
  const double least = relative ? -1 : -unbounded;
  const double change = unknown ? 0 : relative ? relative_change(before, after) : after - before;
  low_.push_back(unknown ? least : change);
  high_.push_back(unknown ? unbounded : change);
  middle_.push_back(change);
}

Shift PairwiseChanges::shift(const IntervalRank& rank) {
  Shift shift;
  shift.estimate = median(middle_);
  std::tie(shift.low, shift.high) = ends(low_, high_, rank.rank);
  shift.confidence = rank.confidence;
  return shift;
}

IntervalRank rank_sum_interval(std::size_t m, std::size_t n, double confidence) {
  if (m > exact_rank_sum || n > exact_rank_sum) return approximate_rank_sum(m, n, confidence);
  const std::vector<double> probability = rank_sum_distribution(m, n);
  const double tail = (1 - confidence) / 2;
  IntervalRank result{1, 1 - 2 * probability[0]};
  double below = probability[0];  // P(W < k) for k = 1
  for (std::size_t k = 1; 2 * k <= probability.size() && below <= tail; ++k) {
    result = {k, 1 - 2 * below};
    below += probability[k];
  }
  result.confidence = std::max(0.0, result.confidence);
  return result;
}

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

const IntervalRank& ShiftEstimator::rank(std::size_t m, std::size_t n, double confidence) {
  const auto [entry, is_new] = ranks_.try_emplace({{m, n}, confidence});
  if (is_new) entry->second = rank_sum_interval(m, n, confidence);
  return entry->second;
}

std::optional<Shift> ShiftEstimator::between(const std::vector<double>& before,
                                             const std::vector<double>& after, double confidence) {
  if (before.empty() || after.empty()) return std::nullopt;
  PairwiseChanges changes;
  for (const double b : before) {
    for (const double a : after) changes.add(b, a, false);
  }
  return changes.shift(rank(before.size(), after.size(), confidence));
}

std::optional<Shift> ShiftEstimator::ratio(const std::vector<double>& before,
                                           const std::vector<double>& after, double confidence) {
  if (before.empty() || after.empty()) return std::nullopt;
  PairwiseChanges changes;
  for (const double b : before) {
    for (const double a : after) changes.add(b, a, true);
  }
  return changes.shift(rank(before.size(), after.size(), confidence));
}

}  // namespace stormproof::diff
