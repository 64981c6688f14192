// By how much one sample is shifted against another, without assuming a distribution: the
// Hodges–Lehmann estimate with the confidence interval that belongs to the Wilcoxon rank-sum test
// (Hollander, Wolfe, Chicken, "Nonparametric Statistical Methods", section 4.2–4.3), and the
// median of paired ratios with the interval of the sign test (section 3.4–3.6). Completion times of
// a storm have no distribution that anybody knows, so nothing else would be honest.
#pragma once

#include <cstddef>
#include <map>
#include <optional>
#include <utility>
#include <vector>

#include "checker/experiments/diff/diff.hpp"

namespace stormproof::diff {

/// Which order statistics bound an interval: the `rank`-th from below and from above, from 1.
struct IntervalRank {
  std::size_t rank = 1;
  double confidence = 0;  ///< reached by it
};

/// Largest samples whose rank-sum distribution is computed exactly; beyond, its normal
/// approximation serves.
inline constexpr std::size_t exact_rank_sum = 50;

/// Of the differences between samples of sizes m and n (≥ 1): the greatest k with
/// P(W < k) ≤ (1 − confidence)/2, W the Mann–Whitney count without ties. With samples so few that
/// there is none, k = 1 and what that reaches.
[[nodiscard]] IntervalRank rank_sum_interval(std::size_t m, std::size_t n, double confidence);

/// The same for the median of n ≥ 1 values: P(B < k) ≤ (1 − confidence)/2, B binomial(n, 1/2).
[[nodiscard]] IntervalRank sign_interval(std::size_t n, double confidence);

/// after / before − 1 of values ≥ 0, not both infinite.
[[nodiscard]] double relative_change(double before, double after);

/// Changes of which some are known only to lie between two bounds. Their order statistics bound the
/// shift; pairs that are not independent (all pairs of two samples) need the rank-sum ranks, pairs
/// of runs with the same schedule those of the sign test.
class PairwiseChanges {
 public:
  void add(double before, double after, bool relative);
  [[nodiscard]] std::size_t size() const { return middle_.size(); }
  /// There must be at least one change.
  [[nodiscard]] Shift shift(const IntervalRank& rank);

 private:
  std::vector<double> low_, high_, middle_;
};

/// Remembers ranks: a grid asks for the same sizes again and again.
class ShiftEstimator {
 public:
  /// Shift from `before` to `after`: every value finite or +infinity (a run that did not complete).
  /// infinity − infinity is not known; it counts as −infinity for the lower end of the interval, as
  /// +infinity for the upper end, and as 0 for the estimate. Ties only make the interval wider than
  /// it had to be. Absent if a sample is empty.
  [[nodiscard]] std::optional<Shift> between(const std::vector<double>& before,
                                             const std::vector<double>& after, double confidence);

  /// The same for the relative change, after / before − 1, of values ≥ 0: the shift of their
  /// logarithms. 0 / 0 is no change; infinity / infinity counts as −1 for the lower end, as
  /// +infinity for the upper end, and as no change for the estimate.
  [[nodiscard]] std::optional<Shift> ratio(const std::vector<double>& before,
                                           const std::vector<double>& after, double confidence);

 private:
  [[nodiscard]] const IntervalRank& rank(std::size_t m, std::size_t n, double confidence);

  std::map<std::pair<std::pair<std::size_t, std::size_t>, double>, IntervalRank> ranks_;
};

}  // namespace stormproof::diff
