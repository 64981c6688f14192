// The arithmetic of the response-aware HEARTBEAT policy: how long the next period is, given how
// many of the contacted readers responded. The paper's T* = clip(T / max(A/H, ε), T_min, T_max), in
// whole nanoseconds.
#pragma once

#include "fsm/domain.hpp"

namespace stormproof::fsm {

/// What the timer remembers of the running or last cycle. Times in ns; ε = epsilon_num /
/// epsilon_den.
template <class D>
struct AdaptiveCycle {
  typename D::Int start{};      ///< c, when the cycle started
  typename D::Int period{};     ///< T
  typename D::Int contacted{};  ///< H, readers that the cycle contacted
  typename D::Int responded{};  ///< A, how many of them have responded
  typename D::Int min_period{};
  typename D::Int max_period{};
  typename D::Int epsilon_num{1};
  typename D::Int epsilon_den{20};
};

template <class D>
constexpr typename D::Int clamped_period(const AdaptiveCycle<D>& cycle, const typename D::Int& t) {
  return max<D>(cycle.min_period, min<D>(t, cycle.max_period));
}

/// a·b/c rounded to nearest, half up; for c > 0 and non-negative a, b.
template <class D>
constexpr typename D::Int scaled(const typename D::Int& a, const typename D::Int& b,
                                 const typename D::Int& c) {
  return (2 * a * b + c) / (2 * c);
}

/// T* at the end of a cycle: never shorter than T.
template <class D>
constexpr typename D::Int stretched_period(const AdaptiveCycle<D>& cycle) {
  const auto enough = cycle.epsilon_den * cycle.responded >= cycle.epsilon_num * cycle.contacted;
  // The divisor is 1 where the quotient is not used, so that it is never 0.
  const typename D::Int responded = max<D>(cycle.responded, 1);
  const typename D::Int by_share = scaled<D>(cycle.period, cycle.contacted, responded);
  const typename D::Int by_floor = scaled<D>(cycle.period, cycle.epsilon_den, cycle.epsilon_num);
  const typename D::Int target = D::select(enough, by_share, by_floor);
  return max<D>(cycle.period, clamped_period<D>(cycle, target));
}

/// Readers in one batch of the rest of the period: max(1, A, ⌈H·ε⌉).
template <class D>
constexpr typename D::Int batch_size(const AdaptiveCycle<D>& cycle) {
  const typename D::Int share =
      (cycle.contacted * cycle.epsilon_num + cycle.epsilon_den - 1) / cycle.epsilon_den;
  return max<D>(1, max<D>(cycle.responded, share));
}

}  // namespace stormproof::fsm
