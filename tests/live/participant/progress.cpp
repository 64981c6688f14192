// The clock of captures.
#include "progress.hpp"

#include <cerrno>
#include <chrono>
#include <ctime>

namespace stormproof::live {

std::int64_t now_ns() {
  return std::chrono::duration_cast<std::chrono::nanoseconds>(
             std::chrono::system_clock::now().time_since_epoch())
      .count();
}

void sleep_until_ns(std::int64_t instant_ns) {
  const timespec instant{.tv_sec = instant_ns / 1'000'000'000,
                         .tv_nsec = instant_ns % 1'000'000'000};
  while (clock_nanosleep(CLOCK_REALTIME, TIMER_ABSTIME, &instant, nullptr) == EINTR) {
  }
}

}  // namespace stormproof::live
