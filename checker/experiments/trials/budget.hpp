// The time by the clock that a study may take (--time), and its parts. Every study plans with this
// one: how much is left, which share of it a stage may use, when that is over, and how many runs
// fit into it.
#pragma once

#include <cstddef>
#include <functional>
#include <limits>
#include <optional>
#include <utility>

namespace stormproof::trials {

class Budget {
 public:
  /// Seconds that are left, asked of whoever looks at the clock; nothing: as long as it takes.
  using Clock = std::function<std::optional<double>()>;

  /// As long as it takes.
  Budget() = default;
  /// All that `clock` has left; as long as it takes if it has no end.
  explicit Budget(Clock clock);

  [[nodiscard]] bool is_limited() const { return clock_ != nullptr; }
  /// Seconds, at least 0; infinite if it is not limited.
  [[nodiscard]] double left() const;
  [[nodiscard]] bool is_over() const { return left() <= 0; }
  /// Which share of it is over: 0 … 1; 0 if it is not limited.
  [[nodiscard]] double used() const;
  /// The first `share` of what is left now.
  [[nodiscard]] Budget part(double share) const;

 private:
  Clock clock_;          ///< empty: it is not limited
  double reserved_ = 0;  ///< seconds of the clock that are left for what comes after it
  double whole_ = std::numeric_limits<double>::infinity();  ///< seconds, when it was made
};

/// How long runs take, by those that were made since it was made.
class Pace {
 public:
  /// `made`: runs that are made already.
  Pace(Budget budget, std::size_t made)
      : budget_{std::move(budget)}, left_{budget_.left()}, made_{made} {}

  /// How many more like those up to now, `made` in all, surely fit into what is left of `rest`, a
  /// part of the same budget: some take longer than those before. At least one.
  [[nodiscard]] std::size_t fitting(const Budget& rest, std::size_t made) const;

 private:
  Budget budget_;
  double left_;  ///< of it, at the beginning
  std::size_t made_;
};

}  // namespace stormproof::trials
