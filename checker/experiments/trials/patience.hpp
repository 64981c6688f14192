// How long a run has to be simulated until it can only be the worse one. What takes several times
// as long as the best of those that it is compared with is not wanted, however much longer it
// takes, and storms are what takes long to simulate. So such a run is cut: it takes at least that
// long, which is said, and never counted as a time that was measured.
#pragma once

#include <algorithm>
#include <cmath>

#include "model/units.hpp"

namespace stormproof::trials {

/// A run may take so many times as long as the unchanged setting (median).
inline constexpr double beside_unchanged = 2;
/// The same of the best setting so far, from which others differ in what else they cost.
inline constexpr double beside_best = 4;

class Patience {
 public:
  /// Cuts nothing before `limit`, which all runs end at.
  Patience(model::Nanoseconds limit) : Patience{limit, limit} {}  // NOLINT: a limit alone is one
  /// Cuts nothing before `least`.
  Patience(model::Nanoseconds limit, model::Nanoseconds least)
      : limit_{limit}, least_{std::min(limit, least)} {}

  /// Something to compare with takes `completion` ns (infinite: more than is known), and what takes
  /// `factor` times as long is not wanted.
  void see(double completion, double factor) {
    const double enough = factor * completion;
    if (enough >= static_cast<double>(limit_.count())) return;
    limit_ = std::max(least_, model::Nanoseconds{std::llround(enough)});
  }

  /// Simulated time that a run may take.
  [[nodiscard]] model::Nanoseconds limit() const { return limit_; }
  /// Whether that may become less.
  [[nodiscard]] bool may_cut() const { return limit_ > least_; }

 private:
  model::Nanoseconds limit_, least_;
};

}  // namespace stormproof::trials
