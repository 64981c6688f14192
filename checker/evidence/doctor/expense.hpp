// What a captured discovery took: the figures by which exact/storm.hpp says whether it is a storm.
// A capture shows packets, and not how long a channel took for them. With a channel's profile their
// airtime is what the model's channel takes for packets of their sizes; without one messages stand
// for it.
#pragma once

#include <cstdint>
#include <optional>

#include "checker/engines/exact/storm.hpp"
#include "checker/evidence/capture/counting.hpp"
#include "model/counts.hpp"
#include "model/wireless_profile.hpp"

namespace stormproof::doctor {

/// When the last participant announced itself first.
[[nodiscard]] std::int64_t last_start_ns(const capture::Conversation& conversation);

/// When everybody had everything, as far as the capture shows it: of each relation the first
/// ACKNACK that acknowledges all that was sent to it, or, where there is none, the last DATA. At
/// least when the last descriptor was sent first, and the last type was asked for or told.
[[nodiscard]] std::int64_t discovered_ns(const capture::Conversation& conversation,
                                         const capture::Counting& counting);

/// Until then; `incomplete` if somebody lacks a descriptor. `failure_free` is what the same
/// participants need.
[[nodiscard]] exact::Expense expense_of(const capture::Conversation& conversation,
                                        const capture::Counting& counting,
                                        const model::Counts& failure_free, bool incomplete,
                                        const model::WirelessProfile* channel);

}  // namespace stormproof::doctor
