// Watches what a participant discovers and notes the instant at which it has everything: "app" is
// the paper's measure (all matched counters reached), "strict" means that every endpoint of all
// other hosts is known, also those that match nothing here.
#pragma once

#include <atomic>
#include <cstddef>
#include <cstdint>

namespace stormproof::live {

/// The wall clock in ns since 1970: that of the captures.
[[nodiscard]] std::int64_t now_ns();
/// Returns at this instant, or at once if it is over.
void sleep_until_ns(std::int64_t instant_ns);

/// Counts up to what is expected and keeps the instant of the last one. Callbacks of several
/// threads may count.
class Milestone {
 public:
  explicit Milestone(std::size_t expected) : expected_(static_cast<std::int64_t>(expected)) {}

  void add(std::int64_t change) {
    if (count_.fetch_add(change) + change == expected_) {
      reached_ns_ = now_ns();
    }
  }
  [[nodiscard]] std::int64_t count() const { return count_; }
  [[nodiscard]] std::int64_t expected() const { return expected_; }
  /// ns since 1970; 0: not reached.
  [[nodiscard]] std::int64_t reached_ns() const { return reached_ns_; }

 private:
  std::int64_t expected_;
  std::atomic<std::int64_t> count_{0};
  std::atomic<std::int64_t> reached_ns_{0};
};

struct Progress {
  Progress(std::size_t matches, std::size_t discoveries) : app(matches), strict(discoveries) {}

  [[nodiscard]] bool is_complete() const {
    return app.reached_ns() != 0 && strict.reached_ns() != 0;
  }

  Milestone app;
  Milestone strict;
};

}  // namespace stormproof::live
