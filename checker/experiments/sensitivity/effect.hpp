// The effect of a change: the median of the differences between runs with and without it, pair by
// pair with the same seed, and how sure it is. The interval is that of the sign test: order
// statistics of the differences, exact for any distribution, with nothing to draw or to assume.
#pragma once

#include <cstddef>
#include <vector>

namespace stormproof::sensitivity {

struct Effect {
  double median = 0;
  double low = 0, high = 0;  ///< the interval; both are the median if there is one pair
  double confidence = 0;     ///< of the interval: at least 0.95 from six pairs on; 0 for one pair
  bool exactly_zero = true;  ///< no pair differs at all

  /// Whether the interval says in which direction the effect goes.
  [[nodiscard]] bool is_clear() const { return low > 0 || high < 0; }
  bool operator==(const Effect&) const = default;
};

/// `differences` must not be empty.
[[nodiscard]] Effect effect_of(std::vector<double> differences);

}  // namespace stormproof::sensitivity
