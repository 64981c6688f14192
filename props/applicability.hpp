// Which properties say something about which implementation, and about which senders. Most are
// about descriptors and timers that the paper's and Fast DDS's writers have; a verdict about them
// would say nothing of another writer.
#pragma once

#include <string_view>

#include "model/scenario.hpp"

namespace stormproof::props {

/// Why the property does not apply to the implementation, as a clause; empty if it does.
[[nodiscard]] std::string_view why_not_applicable(std::string_view property,
                                                  model::ImplementationKind implementation);
/// The same for a scenario: also, why not with a sender that stalls.
[[nodiscard]] std::string_view why_not_applicable(std::string_view property,
                                                  const model::Scenario& scenario);

/// Whether what engines prove holds for the scenario's participants whatever a run does. They know
/// rules that run at once when a timer is due; a participant that stalls (`sender: stalls`) runs
/// them later, and an asynchronous run in parts. Then only what is about the machines and the
/// composition as such is proved; all else is observed.
[[nodiscard]] bool is_provable(std::string_view property, const model::Scenario& scenario);

}  // namespace stormproof::props
