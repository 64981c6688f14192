// The watch: a thread that waits for the end of the work or of the time.
#include "checker/engines/smt/deadline.hpp"

#include <algorithm>
#include <utility>

namespace stormproof::smt {

Deadline::Deadline(z3::context& context, std::chrono::milliseconds limit,
                   std::function<bool()> interrupted)
    : context_{context}, interrupted_{std::move(interrupted)} {
  if (interrupted_ && interrupted_()) throw Interrupted{};
  // A day is for ever, and safe to add to the clock.
  const auto bounded = std::clamp(limit, std::chrono::milliseconds{1},
                                  std::chrono::milliseconds{std::chrono::hours{24}});
  watch_ = std::thread{[this, bounded] {
    std::unique_lock lock{mutex_};
    const auto end = std::chrono::steady_clock::now() + bounded;
    constexpr std::chrono::milliseconds glance{20};
    while (true) {
      const auto soon = std::chrono::steady_clock::now() + glance;
      const auto next = expired_ ? soon : interrupted_ ? std::min(end, soon) : end;
      if (wake_.wait_until(lock, next, [this] { return done_; })) return;
      stopped_ = stopped_ || (interrupted_ && interrupted_());
      expired_ = stopped_ || std::chrono::steady_clock::now() >= end;
      // The interruption may come before the work has begun; it is repeated until somebody notices.
      if (expired_) context_.interrupt();
    }
  }};
}

Deadline::~Deadline() {
  {
    const std::lock_guard lock{mutex_};
    done_ = true;
  }
  wake_.notify_all();
  watch_.join();
}

const char* Deadline::why() {
  const std::lock_guard lock{mutex_};
  return stopped_ ? "interrupted" : "time-out";
}

bool Deadline::expired() {
  const std::lock_guard lock{mutex_};
  return expired_;
}

}  // namespace stormproof::smt
