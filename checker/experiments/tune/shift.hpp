// By how much one setting differs from another: the Hodges–Lehmann estimate of paired differences
// (the median of the means of all pairs of them), with the interval of Wilcoxon's signed-rank test.
// Pairs have the same seed. The interval is exact if differences are equally likely in both
// directions about their centre, and two settings without a difference have just that.
#pragma once

#include <cstddef>
#include <vector>

namespace stormproof::tune {

struct Shift {
  double estimate = 0;
  double low = 0, high = 0;
  double confidence = 0;  ///< of the interval; at least 0.95 from six pairs on
  bool exact = false;     ///< one pair of runs that stand for all: the difference is a fact

  /// Whether the interval says in which direction the difference goes.
  [[nodiscard]] bool is_less() const { return (exact || confidence >= 0.95) && high < 0; }
  [[nodiscard]] bool is_more() const { return (exact || confidence >= 0.95) && low > 0; }
};

/// `differences` must not be empty, nor contain NaN.
[[nodiscard]] Shift shift_of(std::vector<double> differences);

}  // namespace stormproof::tune
