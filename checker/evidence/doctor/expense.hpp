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
#include "model/limits.hpp"
#include "model/wireless_profile.hpp"

namespace stormproof::doctor {

struct Discovered {
  std::int64_t last_in_time_ns = 0;  ///< what is later is late (`exact::late_limit`)
  /// When everybody had everything, as far as acknowledgments show it.
  std::int64_t known_ns = 0;

  [[nodiscard]] bool is_late(std::int64_t time_ns) const { return time_ns > last_in_time_ns; }
};
[[nodiscard]] Discovered discovered(const capture::Conversation& conversation,
                                    const capture::Counting& counting,
                                    const std::optional<model::Limits>& limits);

/// Until then; `incomplete` if somebody lacks a descriptor. `failure_free` is what the same
/// participants need.
[[nodiscard]] exact::Expense expense_of(const capture::Conversation& conversation,
                                        const capture::Counting& counting,
                                        const model::Counts& failure_free,
                                        const Discovered& discovered, bool incomplete,
                                        const model::WirelessProfile* channel);

}  // namespace stormproof::doctor
