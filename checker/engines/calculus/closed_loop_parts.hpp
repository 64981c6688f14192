// What the closed loop adds to the open one, by implementation.
#pragma once

#include <algorithm>
#include <array>

#include "checker/engines/calculus/closed_loop.hpp"
#include "checker/engines/calculus/open_loop_parts.hpp"

namespace stormproof::calculus {

/// A delay that no packet exceeds, so far.
struct Lateness {
  const model::Scenario& scenario;
  const Omission& omission;
  bool keeps_order = false;    ///< pushed DATA arrives before what its source sends later
  model::Nanoseconds delay{};  ///< D
};

/// How often the writers of a participant use up their budgets, by stream.
using Exhaustions = std::array<std::int64_t, 2>;

/// The least ones that explain themselves: `next(e)` if what e allows is sent. `endless`: each
/// repair causes another.
template <class Next>
Exhaustions settled(Next next) {
  constexpr std::uint32_t most_steps = 10'000;
  constexpr std::int64_t most = 1'000'000'000;
  Exhaustions settled{};
  for (std::uint32_t step = 0; step < most_steps && std::ranges::max(settled) < most; ++step) {
    const Exhaustions more = next(settled);
    if (more == settled) return settled;
    settled = more;
  }
  return {endless, endless};
}

/// What `asks` adds for each participant.
template <class Asks>
Repairs added_by_all(Asks asks, const Flows& flows) {
  Repairs all;
  for (std::uint32_t i = 0; i < flows.topology.participant_count(); ++i) {
    const Repairs own = asks.add_participant(i);
    all.copies = std::max(all.copies, own.copies);
    all.sent = plus(all.sent, own.sent);
  }
  return all;
}

Repairs add_repairs_of_the_paper(const Lateness& lateness, Flows& flows);
Repairs add_repairs_of_fastdds(const Lateness& lateness, Flows& flows);

}  // namespace stormproof::calculus
