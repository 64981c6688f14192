// The engine "timelines": bounds and thresholds of one relation as linear-integer arithmetic,
// proved for all values of the timers, delays and losses (specs/guide/bounds.md).
#pragma once

#include <span>
#include <string_view>

#include "checker/engines/bounds/check_request.hpp"

namespace stormproof::timeline {

/// What this engine decides: live.completion, live.quiescence, storm.single-copy and
/// storm.free-threshold. Never throws.
[[nodiscard]] std::span<const std::string_view> decidable();

/// Decides those of `properties` that it can, for the request's scenario.
[[nodiscard]] checker::Findings check(std::span<const std::string_view> properties,
                                      const checker::CheckRequest& request);

}  // namespace stormproof::timeline
