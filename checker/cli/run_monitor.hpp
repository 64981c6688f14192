// Watches a long run for the person in front of it: progress on stderr, and a clean end on Ctrl-C.
#pragma once

#include <chrono>
#include <csignal>
#include <string>
#include <thread>

namespace stormproof::cli {

/// While it lives, Ctrl-C (SIGINT, SIGTERM, SIGHUP) is remembered instead of ending the program; a
/// second one ends it, without half-written files. The signals are blocked in every thread and
/// taken from a descriptor by one of our own, so no handler that a library installs (Z3 does,
/// around each query) can swallow them. That thread looks after memory, too: short of it, the work
/// is stopped as by Ctrl-C, while there is some left for saying what is known.
class InterruptGuard {
 public:
  InterruptGuard();
  ~InterruptGuard();
  InterruptGuard(const InterruptGuard&) = delete;
  InterruptGuard& operator=(const InterruptGuard&) = delete;

  /// Whether the work is to stop.
  [[nodiscard]] static bool interrupted();
  /// Whether that is because memory runs short.
  [[nodiscard]] static bool short_of_memory();

 private:
  void watch() const;

  sigset_t before_{};  ///< the signals that were blocked
  int signals_ = -1;
  int end_ = -1;  ///< of the watch
  std::thread watch_;
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
