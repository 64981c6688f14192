// The parts that the generators of random scenarios share, whatever the implementation: the
// wireless profile, and a clock that makes durations of one scale, many of them equal.
#pragma once

#include <algorithm>
#include <cstdint>

#include "model/scenario.hpp"
#include "tests/oracle/random_dice.hpp"

namespace stormproof::oracle {

/// Durations of one scenario: around a common scale, and multiples of a grid if ties are wanted. In
/// lockstep everything, the airtimes included, takes a small multiple of the grid.
struct Clock {
  std::int64_t scale = 0;
  std::int64_t grid = 1;
  bool lockstep = false;

  [[nodiscard]] std::int64_t on_grid(std::int64_t t) const {
    return t == 0 ? 0 : std::max(grid, t / grid * grid);
  }
};

/// Fills in every knob of the wireless profile.
void fill_wireless(Dice& dice, model::WirelessProfile& w);

/// Chooses the scale from the scenario's sizes and rates. In lockstep it also gives every stage an
/// airtime of one or two steps, so that service and timers meet all the time.
[[nodiscard]] Clock make_clock(Dice& dice, model::Scenario& scenario);

/// A delay between cause and reaction: anything from nothing to a second, more often short.
[[nodiscard]] model::Nanoseconds reaction(Dice& dice, const Clock& clock, std::int64_t usual);

/// A period: never so short that its events alone fill the run.
[[nodiscard]] model::Nanoseconds period(Dice& dice, const Clock& clock);

}  // namespace stormproof::oracle
