// In whose runs a mistake can show itself: of the implementations whose composition has what it is
// about.
#pragma once

#include <string_view>
#include <vector>

#include "model/dds_profile.hpp"
#include "model/event.hpp"

namespace stormproof::mutate {

/// Implementations, in their order.
using Concerns = std::vector<model::ImplementationKind>;

[[nodiscard]] Concerns everywhere();
/// Where rules feed this event to such a machine; everywhere if it belongs to the network.
[[nodiscard]] Concerns where_is_fed(std::string_view machine, std::string_view event);
/// Where there are events of this kind.
[[nodiscard]] Concerns where_happens(model::EventKind kind);
/// Where the relation rules are knobs of the profile.
[[nodiscard]] Concerns where_rules_are_knobs();
/// The first that executes the composition of this name, if its runs are followed; otherwise
/// nobody: nothing could notice a mistake in its effects.
[[nodiscard]] Concerns where_is_composition(std::string_view name);

}  // namespace stormproof::mutate
