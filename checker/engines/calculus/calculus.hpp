// The engine "network calculus": what a deployment can do to its channel, from arrival curves and
// the longest busy period (specs/guide/cannot-start.md). It decides storm.cannot-start,
// and live.completion and live.quiescence from the deployment alone.
#pragma once

#include <span>
#include <string_view>

#include "checker/engines/bounds/check_request.hpp"

namespace stormproof::calculus {

/// Decides those of `properties` that it can, for the request's scenario. Never throws. It is
/// silent with a mutant: what it proves is about the correct rules.
[[nodiscard]] checker::Findings check(std::span<const std::string_view> properties,
                                      const checker::CheckRequest& request);

}  // namespace stormproof::calculus
