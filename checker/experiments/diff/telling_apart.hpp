// The least scenario whose runs differ between two profiles: what a reviewer looks at to understand
// what a change does. It is searched from the smallest deployments upward, then shrunk.
#pragma once

#include <cstdint>
#include <functional>

#include "checker/experiments/diff/diff.hpp"

namespace stormproof::diff {

/// Most events that searching and shrinking may take together. A number of events and not a time,
/// so that the answer is the same on every machine.
inline constexpr std::uint64_t telling_apart_events = 10'000'000;

/// Searches small deployments and simple channels, then `start` (a scenario of the user's; its
/// `dds` is not looked at). `goes_on` returning false ends the search with what is known.
[[nodiscard]] TellingApart tell_apart(const model::Scenario& start, const model::DdsProfile& base,
                                      const model::DdsProfile& candidate,
                                      const std::function<bool()>& goes_on);

}  // namespace stormproof::diff
