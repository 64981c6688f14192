// When something can have happened that a capture does not show, and when timers can have fired.
#pragma once

#include <algorithm>
#include <cstdint>
#include <optional>

#include "checker/evidence/conform/bounds.hpp"
#include "checker/evidence/conform/words.hpp"

namespace stormproof::conform {

/// The instants between which something happens.
struct Window {
  std::int64_t from_ns = 0;
  std::int64_t to_ns = 0;

  [[nodiscard]] Window after(std::int64_t delay_ns) const {
    return {from_ns + delay_ns, to_ns + delay_ns};
  }
  [[nodiscard]] bool contains(const Window& other) const {
    return from_ns <= other.from_ns && to_ns >= other.to_ns;
  }
};

/// When what was captured then was sent, if it waited for `wait_ns` at most.
[[nodiscard]] inline Window sent_within(std::int64_t wait_ns, std::int64_t captured_ns) {
  return {captured_ns - wait_ns, captured_ns + capture_resolution_ns};
}
[[nodiscard]] inline Window sent_in(const Bounds& bounds, std::int64_t captured_ns) {
  return sent_within(bounds.most_send_lag_ns, captured_ns);
}
/// When a timer fired that is due in `due`, if what it sends was sent in `sent`.
[[nodiscard]] inline std::optional<Window> fired(const Bounds& bounds, const Window& due,
                                                 const Window& sent) {
  const Window at{std::max(due.from_ns, sent.from_ns),
                  std::min(due.to_ns + bounds.most_lateness_ns, sent.to_ns)};
  if (at.from_ns > at.to_ns) return std::nullopt;
  return at;
}
/// When a timer that is due at `due_ns` has surely fired, and what it sends has been captured.
[[nodiscard]] inline std::int64_t surely_after(const Bounds& bounds, std::int64_t due_ns) {
  return due_ns + bounds.most_lateness_ns + bounds.most_send_lag_ns;
}
/// Whether that was before `time_ns`.
[[nodiscard]] inline bool is_overdue(const Bounds& bounds, const Window& due,
                                     std::int64_t time_ns) {
  return surely_after(bounds, due.to_ns) < time_ns;
}

}  // namespace stormproof::conform
