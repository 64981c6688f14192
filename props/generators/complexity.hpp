// What "simpler" means for scenarios: an order without infinite descents, so that shrinking ends.
#pragma once

#include <array>
#include <compare>
#include <cstdint>

#include "model/scenario.hpp"

namespace stormproof::props {

/// Numbers of at least 0, the first of which counts most. Every step of shrinking makes it smaller,
/// in the order of its members.
struct Complexity {
  std::uint64_t participants = 0;
  std::uint64_t hosts = 0;      ///< sum of the host numbers, those of the first counting most
  std::uint64_t endpoints = 0;  ///< of the users
  std::uint64_t failures = 0;   ///< in the life of participants
  std::uint64_t packets = 0;    ///< lost or delayed in a way of their own, unlike in the base
  std::uint64_t route = 0;    ///< 0 for the base's; else its stages, changes of channel, overrides
  std::uint64_t changed = 0;  ///< knobs that differ from the base; 1 more for its implementation
  std::uint64_t digits = 0;   ///< sum of `number_cost` over these knobs
  std::uint64_t numbers = 0;  ///< sum of the numbers of these packets

  auto operator<=>(const Complexity&) const = default;
};

[[nodiscard]] Complexity complexity(const model::Scenario& scenario, const model::Scenario& base);

/// How complicated `value` ≥ 0 is where `base` is usual: 0 for the base, 1 for zero, then by number
/// of significant decimal digits, by the first digit, and by the distance to the base in orders of
/// magnitude.
[[nodiscard]] std::uint64_t number_cost(std::int64_t value, std::int64_t base);

}  // namespace stormproof::props
