// The clock of a stateful test of a machine that waits for a timer of Cyclone DDS.
#pragma once

#include <algorithm>
#include <cstdint>
#include <optional>
#include <string>

namespace stormproof::fsm::stateful {

/// A timer that is only moved to earlier times; it is taken when it is due.
struct MovedTimer {
  std::int64_t now = 0;
  std::optional<std::int64_t> due;

  /// Time goes on, but not past the timer.
  void wait(std::int64_t time) { now = due ? std::min(now + time, *due) : now + time; }
  void move(std::int64_t to) {
    if (!due || to < *due) due = to;
  }
  void take() {
    now = std::max(now, *due);
    due.reset();
  }
  [[nodiscard]] std::string in_words() const {
    return "at " + std::to_string(now) + (due ? ", due at " + std::to_string(*due) : "");
  }
};

}  // namespace stormproof::fsm::stateful
