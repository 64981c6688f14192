// Watches a long run for the person in front of it: progress on stderr, and a clean end on Ctrl-C.
#pragma once

#include <chrono>
#include <string>

namespace stormproof::cli {

/// While it lives, Ctrl-C (SIGINT, SIGTERM) is remembered instead of ending the program.
class InterruptGuard {
 public:
  InterruptGuard();
  ~InterruptGuard();
  InterruptGuard(const InterruptGuard&) = delete;
  InterruptGuard& operator=(const InterruptGuard&) = delete;

  [[nodiscard]] static bool interrupted();
};

/// A line on stderr, renewed four times a second from one second on, and removed in the end.
class StatusLine {
 public:
  explicit StatusLine(bool enabled) : enabled_{enabled} {}
  ~StatusLine();
  StatusLine(const StatusLine&) = delete;
  StatusLine& operator=(const StatusLine&) = delete;

  /// Whether it is time to show something new.
  [[nodiscard]] bool due();
  void show(const std::string& text);
  [[nodiscard]] double seconds() const;

 private:
  using Clock = std::chrono::steady_clock;

  bool enabled_;
  bool shown_ = false;
  Clock::time_point started_ = Clock::now();
  Clock::time_point next_ = started_ + std::chrono::seconds{1};
};

}  // namespace stormproof::cli
