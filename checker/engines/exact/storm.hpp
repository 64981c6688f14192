// What a discovery storm is: the one definition that every verb asks which uses the word, be it
// about a simulated run, many of them, or a capture. The feedback takes several times what it costs
// to send everything once, and it decides when discovery is complete. How that is told depends on
// what is known:
//
// * a run of a model that has an open loop knows both in time: the airtime that was used, and how
//   long it took, each over the airtime of everything sent once;
// * where there is no open loop (a Discovery Server, Cyclone DDS) or no airtime (a capture shows
//   messages, and not how long the channel took for them) messages stand for airtime, over those of
//   a discovery without failures. They say nothing of time, so discovery has to be late as well:
//   not complete, or later than people wait for.
//
// What is less is no storm. From twice the messages on it is amplified: nobody has to act, and
// settings would help.
#pragma once

#include <optional>

#include "model/units.hpp"

namespace stormproof::exact {

/// A storm takes at least so many times what is sent once.
inline constexpr double storm_factor = 3;
/// Messages over those of a discovery without failures from which on it is amplified.
inline constexpr double amplified_factor = 2;
/// Discovery that takes longer than this, counted from the last start, is late, unless the
/// scenario's limits.completion says otherwise.
inline constexpr model::Nanoseconds late{1'000'000'000};

/// What a discovery took, as multiples of what it takes if nothing is sent twice. Either the first
/// two or the third are known.
struct Expense {
  std::optional<double> airtime;   ///< used, over that of everything sent once
  std::optional<double> stretch;   ///< the time it took, over the same
  std::optional<double> messages;  ///< over those of a discovery without failures
  bool is_late = false;            ///< not complete, or later than people wait for
};

[[nodiscard]] constexpr bool is_storm(const Expense& took) {
  if (took.airtime && took.stretch) {
    return *took.airtime >= storm_factor && *took.stretch >= storm_factor;
  }
  return took.is_late && took.messages.value_or(0) >= storm_factor;
}
[[nodiscard]] constexpr bool is_amplified(const Expense& took) {
  return took.messages.value_or(0) > amplified_factor;
}

}  // namespace stormproof::exact
