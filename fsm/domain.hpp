// The domains in which guards and actions are evaluated. Each guard and action has ONE body, a
// template over a domain `D`: `Plain` executes it, another domain (64-bit lanes, solver
// expressions) re-uses the same body to run many machines at once or to prove something about the
// table. A body therefore never branches: it uses
// `&&`, `||`, `!`, comparisons, integer arithmetic and `D::select`.
#pragma once

#include <cstdint>

namespace stormproof::fsm {

/// Ordinary execution: truth values are `bool`, integers are 64 bits wide (times in nanoseconds).
struct Plain {
  using Bool = bool;
  using Int = std::int64_t;

  static constexpr Int select(Bool condition, Int then, Int otherwise) {
    return condition ? then : otherwise;
  }
};

template <class D>
constexpr auto min(const typename D::Int& a, const typename D::Int& b) {
  return D::select(a < b, a, b);
}

template <class D>
constexpr auto max(const typename D::Int& a, const typename D::Int& b) {
  return D::select(a < b, b, a);
}

}  // namespace stormproof::fsm
