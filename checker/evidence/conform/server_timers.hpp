// When something can have happened that a capture does not show, and when timers can have fired.
#pragma once

#include <algorithm>
#include <cstdint>
#include <optional>

#include "checker/evidence/conform/context.hpp"

namespace stormproof::conform::server {

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

/// When what was captured then was sent.
[[nodiscard]] inline Window sent_in(const Context& context, std::int64_t captured_ns) {
  return {captured_ns - context.bounds.most_send_lag_ns, captured_ns + capture_resolution_ns};
}
/// When a timer fired that is due in `due`, if what it sends was sent in `sent`.
[[nodiscard]] inline std::optional<Window> fired(const Context& context, const Window& due,
                                                 const Window& sent) {
  const Window at{std::max(due.from_ns, sent.from_ns),
                  std::min(due.to_ns + context.bounds.most_lateness_ns, sent.to_ns)};
  if (at.from_ns > at.to_ns) return std::nullopt;
  return at;
}

}  // namespace stormproof::conform::server
