// The watch: a thread that waits for the end of the work or of the time.
#include "checker/engines/smt/deadline.hpp"

#include <algorithm>

namespace stormproof::smt {

Deadline::Deadline(z3::context& context, std::chrono::milliseconds limit) : context_{context} {
  // A day is for ever, and safe to add to the clock.
  const auto bounded = std::clamp(limit, std::chrono::milliseconds{1},
                                  std::chrono::milliseconds{std::chrono::hours{24}});
  watch_ = std::thread{[this, bounded] {
    std::unique_lock lock{mutex_};
    const auto end = std::chrono::steady_clock::now() + bounded;
    while (!wake_.wait_until(lock, end, [this] { return done_; })) {
      expired_ = true;
      context_.interrupt();
      // The interruption may come before the work has begun; repeat it until somebody notices.
      if (wake_.wait_for(lock, std::chrono::milliseconds{20}, [this] { return done_; })) return;
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

bool Deadline::expired() {
  const std::lock_guard lock{mutex_};
  return expired_;
}

}  // namespace stormproof::smt
