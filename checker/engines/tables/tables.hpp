// The engine that proves properties of the transition tables themselves, for all inputs, all
// descriptors and all lengths of run: `fsm.*`, `order.*`, `safety.*` without the channel, and
// `timer.single-heartbeat`. It evaluates the very rows that the simulator executes over solver
// expressions; no rule is restated here that a table already says.
#pragma once

#include <span>
#include <string_view>

#include "checker/engines/bounds/check_request.hpp"

namespace stormproof::tables {

/// Ids of all properties that this engine can decide.
[[nodiscard]] std::span<const std::string_view> decidable();

/// Decides those of `properties` that this engine can decide, in the order given. Never throws.
[[nodiscard]] checker::Findings check(std::span<const std::string_view> properties,
                                      const checker::CheckRequest& request);

}  // namespace stormproof::tables
