// What those need who explain each message by itself: the sorted capture, the profile, the bounds.
#pragma once

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
  /// When what was captured at its source then arrives elsewhere, at the earliest.
  [[nodiscard]] std::int64_t earliest_arrival(std::int64_t captured_ns) const {
    return captured_ns + bounds.least_delay_ns - bounds.clock_error_ns;
  }
  /// When a timer that is due at `due_ns` has surely fired, and what it sends has been captured.
  [[nodiscard]] std::int64_t surely_after(std::int64_t due_ns) const {
    return due_ns + bounds.most_lateness_ns + bounds.most_send_lag_ns;
  }
};

}  // namespace stormproof::conform
