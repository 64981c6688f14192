// Which properties say something about which implementation, which senders, hosts and losses. Most
// are about descriptors and timers that the paper's and Fast DDS's writers have; a verdict about
// them would say nothing of another writer.
#pragma once

#include <string_view>

#include "model/scenario.hpp"

namespace stormproof::props {

/// Why the property does not apply to the implementation, as a clause; empty if it does.
[[nodiscard]] std::string_view why_not_applicable(std::string_view property,
                                                  model::ImplementationKind implementation);
/// The same for a scenario: also, why not with its senders, hosts and losses.
[[nodiscard]] std::string_view why_not_applicable(std::string_view property,
                                                  const model::Scenario& scenario);

/// Whether it is about what clients tell a Discovery Server, not about what the server relays.
[[nodiscard]] bool is_about_clients(std::string_view property,
                                    model::ImplementationKind implementation);

/// Why what engines prove of the property would say nothing of this scenario, as a sentence; empty
/// if it would. They know rules that run at once when a timer is due, packets that take one way or
/// are lost by number: not participants that stall or whose threads are busy, listed hosts, or
/// transmissions that fail. Then only what is about the machines and the composition as such is
/// proved; all else is observed.
[[nodiscard]] std::string_view why_not_provable(std::string_view property,
                                                const model::Scenario& scenario);

/// Whether the explorer is the only engine that says something of the property here, besides runs:
/// it executes the rules, and no certificate proves it from them.
[[nodiscard]] bool is_only_explored(std::string_view property,
                                    model::ImplementationKind implementation);

}  // namespace stormproof::props
