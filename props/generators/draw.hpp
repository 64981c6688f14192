// The steps of drawing a scenario. Sizes and the wireless profile come first; they give the time
// scale of the scenario, and all durations follow from that, so that neither all runs complete nor
// none, whatever the rates are.
#pragma once

#include <algorithm>
#include <cstdint>
#include <vector>

#include "model/implementations.hpp"
#include "model/scenario.hpp"
#include "props/generators/dice.hpp"
#include "props/generators/space.hpp"

namespace stormproof::props {

inline constexpr std::int64_t microsecond = 1'000;
inline constexpr std::int64_t millisecond = 1'000'000;
inline constexpr std::int64_t second = 1'000'000'000;

/// Where the durations of one scenario come from, all in ns. Ties are made likely in three ways: by
/// a common grid; by a pool of few values with their sums and differences; in lockstep, where
/// everything, the airtimes included, takes a small multiple of the grid.
struct Clock {
  std::int64_t scale = 0;  ///< about what discovery takes
  std::int64_t grid = 1;
  bool lockstep = false;
  std::vector<std::int64_t> pool;  ///< empty: durations are drawn one by one

  [[nodiscard]] std::int64_t on_grid(std::int64_t t) const {
    return t == 0 ? 0 : std::max(grid, t / grid * grid);
  }
};

/// Chooses the scale from the scenario's sizes and rates. In lockstep it also gives every stage an
/// airtime of one or two steps.
[[nodiscard]] Clock draw_clock(Dice& dice, const ScenarioSpace& space, model::Scenario& scenario);

/// A delay between cause and reaction: anything from nothing to a second, more often short.
[[nodiscard]] model::Nanoseconds draw_reaction(Dice& dice, const Clock& clock, std::int64_t usual);

/// A period: from a tenth of the scale up, so that its events alone do not fill the run.
[[nodiscard]] model::Nanoseconds draw_period(Dice& dice, const Clock& clock);

/// Hosts, placement and endpoints.
void draw_participants(Dice& dice, const ScenarioSpace& space, int size, model::Scenario& scenario);
/// Starts, creation of endpoints, loopback delay, and a time limit that fits.
void draw_times(Dice& dice, const ScenarioSpace& space, const Clock& clock,
                model::Scenario& scenario);

/// All of the DDS profile but its durations.
void draw_rules_and_sizes(Dice& dice, model::Scenario& scenario);
void draw_timers(Dice& dice, const Clock& clock, model::DdsProfile& dds);
/// Whether the delay between initial ACKNACKs doubles. One that stays is a period: it does not get
/// so short that its events alone fill the run.
void draw_attempts(Dice& dice, const Clock& clock, model::SedpProfile& sedp);
/// When readers of Cyclone DDS tell what is fresh.
void draw_notification(Dice& dice, model::DdsProfile& dds);

void draw_wireless(Dice& dice, const ScenarioSpace& space, model::WirelessProfile& wireless);
/// Delays of single packets, which need a clock to meet other events.
void draw_packet_delays(Dice& dice, const Clock& clock, model::WirelessProfile& wireless);

}  // namespace stormproof::props
