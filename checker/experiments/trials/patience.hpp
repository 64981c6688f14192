// How long a run has to be simulated until it can only be the worse one. What takes several times
// as long as the best of those that it is compared with is not wanted, however much longer it
// takes, and storms are what takes long to simulate. So such a run is cut: it takes at least that
// long, which is said, and never counted as a time that was measured. Where there is little time
// and nothing is known yet, patience begins short and doubles until something completes.
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
      : whole_{limit}, least_{std::min(limit, least)}, limit_{limit} {}

  /// Begins with `least`, until something completes.
  [[nodiscard]] static Patience from_least(model::Nanoseconds limit, model::Nanoseconds least) {
    Patience patience{limit, least};
    patience.limit_ = patience.least_;
    patience.waits_ = true;
    return patience;
  }

  /// Something to compare with takes `completion` ns (infinite: more than is known), and what takes
  /// `factor` times as long is not wanted.
  void see(double completion, double factor) {
    if (std::isinf(completion)) return;
    const double enough = factor * completion;
    const model::Nanoseconds before = waits_ ? whole_ : limit_;
    waits_ = false;
    limit_ = enough >= static_cast<double>(before.count())
                 ? before
                 : std::max(least_, model::Nanoseconds{std::llround(enough)});
  }

  /// Twice as long, if nothing that completes was seen yet and a run may take longer.
  bool lengthen() {
    if (!waits_ || limit_ == whole_) return false;
    limit_ = std::min(whole_, limit_ * 2);
    return true;
  }

  /// Simulated time that a run may take.
  [[nodiscard]] model::Nanoseconds limit() const { return limit_; }
  /// What ends earlier without being complete was cut.
  [[nodiscard]] model::Nanoseconds whole() const { return whole_; }
  /// Whether something is still to be seen that changes the limit.
  [[nodiscard]] bool may_cut() const { return waits_ || limit_ > least_; }

 private:
  model::Nanoseconds whole_, least_, limit_;
  bool waits_ = false;  ///< nothing is seen yet
};

}  // namespace stormproof::trials
