// Watches a long run for the person in front of it: progress on stderr, and a clean end on Ctrl-C.
#pragma once

#include <chrono>
#include <csignal>
#include <cstdint>
#include <optional>
#include <string>
#include <thread>

namespace stormproof::cli {

/// Whose process it is: the program's own, or one that it is a part of.
enum class Process : std::uint8_t { own, shared };

/// While it lives, Ctrl-C (SIGINT, SIGTERM, SIGHUP) is remembered instead of ending the program; a
/// second one ends it, without half-written files. The signals are blocked in every thread and
/// taken from a descriptor by one of our own, so no handler that a library installs (Z3 does
/// unless it is told not to) can swallow them. That thread looks after memory and time (`--time`),
/// too: short of either, the work is stopped as by Ctrl-C, and says what is known.
class InterruptGuard {
 public:
  /// `seconds`: how long the work may take; absent: as long as it takes. In a process that others
  /// share signals are theirs, who call `interrupt`.
  explicit InterruptGuard(std::optional<double> seconds, Process process);
  ~InterruptGuard();
  InterruptGuard(const InterruptGuard&) = delete;
  InterruptGuard& operator=(const InterruptGuard&) = delete;

  /// As Ctrl-C does, for whoever hears of that in another way.
  static void interrupt();
  /// Whether the work is to stop.
  [[nodiscard]] static bool interrupted();
  /// Whether that is because memory runs short.
  [[nodiscard]] static bool short_of_memory();
  /// Whether that is because its time is over.
  [[nodiscard]] static bool out_of_time();
  /// Of the time that the work may take, at least 0; absent: as long as it takes.
  [[nodiscard]] static std::optional<double> seconds_left();

 private:
  void watch() const;

  sigset_t before_{};  ///< the signals that were blocked
  int signals_ = -1;   ///< in a process of others there is none
  int end_ = -1;       ///< of the watch
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
