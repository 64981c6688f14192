// What those need who explain each message by itself: the sorted capture, the profile, the bounds.
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>

#include "checker/evidence/conform/bounds.hpp"
#include "checker/evidence/conform/dialogue.hpp"
#include "checker/evidence/conform/words.hpp"
#include "model/dds_profile.hpp"

namespace stormproof::conform {

struct Context {
  const Dialogue& dialogue;
  const model::DdsProfile& dds;
  const Bounds& bounds;

  /// Whether `cause`, captured at its source, can have arrived elsewhere before `time_ns`.
  [[nodiscard]] bool can_precede(std::int64_t cause_ns, std::int64_t time_ns) const {
    return earliest_arrival(cause_ns) <= time_ns + capture_resolution_ns;
  }
  /// How many ACKNACKs of the relation for which `is_one` holds can have arrived before `time_ns`.
  [[nodiscard]] std::size_t arrived(const Relation& relation, std::int64_t time_ns,
                                    auto&& is_one) const {
    return static_cast<std::size_t>(
        std::ranges::count_if(relation.answers, [&](const Answer& answer) {
          return is_one(answer) && can_precede(answer.time_ns, time_ns);
        }));
  }
  /// When what was captured at its source then arrives elsewhere, at the earliest.
  [[nodiscard]] std::int64_t earliest_arrival(std::int64_t captured_ns) const {
    return captured_ns + bounds.least_delay_ns - bounds.clock_error_ns;
  }
};

}  // namespace stormproof::conform
