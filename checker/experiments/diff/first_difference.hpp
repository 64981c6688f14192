// Where the runs of one deployment under two profiles part. What counts first is what a participant
// does: the packets that it sends, when, to whom, with what. Only if all packets are equal does the
// inside count: which event is processed when, and which state it leaves. A timer that only one of
// them has started is no difference before it fires.
#pragma once

#include <cstdint>
#include <functional>
#include <string>
#include <vector>

#include "model/scenario.hpp"

namespace stormproof::diff {

/// How much two runs have in common.
struct Parting {
  enum class Kind : std::uint8_t {
    none,    ///< the runs are equal, or equal as far as both were followed
    inside,  ///< all packets are equal, but not all events
    packets
  };
  Kind kind = Kind::none;
  /// Position of the first difference: among the packets, or among the events.
  std::uint64_t position = 0;
  bool followed_to_the_end = false;  ///< no run was cut short
};

/// Runs `scenario` (its profile is the base) and the same with the profile `candidate`, each for at
/// most `most_events` events. `events` is increased by what that took. `goes_on` returning false
/// cuts the runs short.
[[nodiscard]] Parting compare_runs(const model::Scenario& scenario,
                                   const model::DdsProfile& candidate, std::uint64_t most_events,
                                   std::uint64_t& events, const std::function<bool()>& goes_on);

/// One side of a first difference.
struct Side {
  std::uint64_t event = 0;  ///< what the run does instead of the other, or where it gives up
  model::Nanoseconds time;  ///< of that event
  std::string text;         ///< one sentence
  std::vector<std::uint64_t> packets;  ///< numbers of those that it sends there
};

struct FirstDifference {
  Side base, candidate;
  bool is_silent = false;  ///< one of the runs ends before it sends anything else
  std::string text;        ///< one sentence about both
};

/// What stands at a parting other than `none`. Both runs are followed a little beyond it, to find
/// what one of them does later than the other.
[[nodiscard]] FirstDifference describe_parting(const model::Scenario& scenario,
                                               const model::DdsProfile& candidate,
                                               const Parting& parting);

}  // namespace stormproof::diff
