// The domain of 64 descriptors at once: a truth value is a word, one bit for each. The terms of a
// composition (fsm/composition/vocabulary.hpp) are evaluated in it when the simulator executes
// rules.
#pragma once

#include <cstdint>

namespace stormproof::model {

/// A truth value of each of 64 descriptors. Bits of numbers that the stream does not have mean
/// nothing.
struct Lanes {
  std::uint64_t bits = 0;

  constexpr Lanes() = default;
  constexpr Lanes(bool all) : bits{all ? ~std::uint64_t{0} : 0} {}
  constexpr explicit Lanes(std::uint64_t bits_) : bits{bits_} {}

  friend constexpr Lanes operator!(Lanes a) { return Lanes{~a.bits}; }
  friend constexpr Lanes operator&&(Lanes a, Lanes b) { return Lanes{a.bits & b.bits}; }
  friend constexpr Lanes operator||(Lanes a, Lanes b) { return Lanes{a.bits | b.bits}; }
};

struct LaneDomain {
  using Bool = Lanes;
};

}  // namespace stormproof::model
