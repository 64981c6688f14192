// Scenarios from small to large in which two profiles may part: few participants, few endpoints,
// simple delays, late starters, and losses where something has to be lost before a rule acts.
#pragma once

#include <cstdint>
#include <functional>

#include "model/scenario.hpp"

namespace stormproof::diff {

/// What the small scenarios are made of.
struct SmallScenarios {
  model::DdsProfile base;
  model::Nanoseconds suppression;  ///< the longer nack suppression duration of the two
  model::Nanoseconds horizon;      ///< time limit: late effects of both profiles fit in
  model::WirelessProfile shared;   ///< a shared channel without losses
  /// Of one of the profiles; of one that creates endpoints over time, if there is one.
  model::ImplementationKind implementation{};
};

/// Returning true ends the search.
using Visit = std::function<bool(const model::Scenario&)>;

/// The simplest of all, to which others are shrunk: two hosts with one participant each and no user
/// endpoints, one millisecond apart.
[[nodiscard]] model::Scenario plainest_scenario(const SmallScenarios& parts);

/// So many participants, each on a host of its own: without losses, with late starters, then with
/// single packets and whole bursts lost. Returns whether a visit ended it.
bool visit_small_scenarios(const SmallScenarios& parts, std::uint32_t participants,
                           const Visit& visit);

/// So many random scenarios with all that a scenario can have, with two participants or with any
/// number up to six.
inline constexpr std::uint64_t random_pairs = 1'000;
inline constexpr std::uint64_t random_groups = 3'000;
enum class Crowd : std::uint8_t { pair, group };
bool visit_random_scenarios(const SmallScenarios& parts, Crowd crowd, const Visit& visit);

}  // namespace stormproof::diff
