// The one test of two settings on equal seeds: the median of the differences, pair by pair, with
// the interval of the sign test (Hollander, Wolfe, Chicken, "Nonparametric Statistical Methods",
// section 3.4–3.6). `diff`, `sensitivity` and `tune` all ask that one question, and this is why it
// is answered so:
//
// * Runs under one seed start alike, so the pair is what is independent, not the run. A rank-sum
//   test ignores that and claims too much or too little, as the pairs go together or not.
// * Outcomes of a storm are heavy-tailed, and differences of them lie in no way evenly about their
//   middle. The signed-rank interval (Hodges–Lehmann) needs just that; the sign test needs nothing.
// * Of a run that did not complete only its place in an order is known (`completion.hpp`). The sign
//   test uses no more than places; means of pairs, as the signed-rank test takes them, use sizes.
// * It is the same for differences, quotients and logarithms, and exact for any number of pairs.
//
// What it costs: among even, light-tailed differences it needs up to half as many pairs again as
// signed ranks. At few pairs it costs nothing: no test of n pairs reaches more than 1 − 2^(1 − n),
// both reach that with the least and the greatest difference, and with 12 pairs and 95 % the
// interval leaves out two differences at each end.
#pragma once

#include <cstddef>
#include <limits>
#include <vector>

#include "checker/experiments/statistics/confidence.hpp"

namespace stormproof::statistics {

/// Which order statistics bound an interval: the `rank`-th from below and from above, from 1.
struct IntervalRank {
  std::size_t rank = 1;
  double confidence = 0;  ///< reached by it
};

/// Of the median of n ≥ 1 values: the greatest k with P(B < k) ≤ (1 − confidence)/2, B
/// binomial(n, 1/2). With values so few that there is none, k = 1 and what that reaches.
[[nodiscard]] IntervalRank sign_interval(std::size_t n, double confidence);

/// How many pairs it takes at least to reach a confidence below 1.
[[nodiscard]] std::size_t fewest_pairs(double confidence);

/// By how much one setting differs from another.
struct Shift {
  double estimate = 0;       ///< the median of the differences; may be infinite
  double low = 0, high = 0;  ///< its interval; may be infinite
  double confidence = 0;     ///< of the interval, reached: less than asked for if pairs are few
  bool exact = false;        ///< one pair of runs that stand for all: the difference is a fact

  /// Whether the interval, with the usual confidence, says in which direction the difference goes.
  [[nodiscard]] bool is_less() const { return is_sure() && high < 0; }
  [[nodiscard]] bool is_more() const { return is_sure() && low > 0; }
  [[nodiscard]] bool is_sure() const { return exact || confidence >= confidence_level; }
  bool operator==(const Shift&) const = default;
};

/// after / before − 1 of values ≥ 0: 0 for 0 / 0, NaN if both are infinite.
[[nodiscard]] double relative_change(double before, double after);

/// The differences of pairs of runs.
class PairedDifferences {
 public:
  /// NaN (∞ − ∞, ∞ / ∞: neither run completed) says that nothing is known but that the difference
  /// is at least `least`: it counts as that for the lower end of the interval, as +∞ for the upper
  /// end, and as 0 for the estimate.
  void add(double difference, double least = -std::numeric_limits<double>::infinity());
  /// It lies between these, either of which may be infinite; the one of them that is nearest to no
  /// difference stands for it in the estimate, as no more is known.
  void add_between(double low, double high);
  void add_relative(double before, double after) { add(relative_change(before, after), -1); }

  [[nodiscard]] std::size_t size() const { return middle_.size(); }
  /// Whether no pair differs at all.
  [[nodiscard]] bool all_zero() const;
  /// There must be at least one pair.
  [[nodiscard]] Shift shift(double confidence = confidence_level) const;
  /// Of one pair whose runs are the only ones that there are.
  [[nodiscard]] Shift fact() const;

 private:
  std::vector<double> low_, high_, middle_;
};

}  // namespace stormproof::statistics
