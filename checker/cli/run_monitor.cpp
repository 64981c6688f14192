// Signal handling and the progress line.
#include "checker/cli/run_monitor.hpp"

#include <csignal>
#include <cstdio>

#include <fmt/core.h>

namespace stormproof::cli {

namespace {

volatile std::sig_atomic_t interrupt_seen = 0;

void remember(int signal) {
  // A second Ctrl-C ends the program as usual.
  interrupt_seen = 1;
  std::signal(signal, SIG_DFL);
}

}  // namespace

InterruptGuard::InterruptGuard() {
  interrupt_seen = 0;
  std::signal(SIGINT, remember);
  std::signal(SIGTERM, remember);
}

InterruptGuard::~InterruptGuard() {
  std::signal(SIGINT, SIG_DFL);
  std::signal(SIGTERM, SIG_DFL);
}

bool InterruptGuard::interrupted() { return interrupt_seen != 0; }

StatusLine::~StatusLine() {
  if (shown_) fmt::print(stderr, "\r\033[K");
}

bool StatusLine::due() {
  if (!enabled_) return false;
  const Clock::time_point now = Clock::now();
  if (now < next_) return false;
  next_ = now + std::chrono::milliseconds{250};
  return true;
}

void StatusLine::show(const std::string& text) {
  fmt::print(stderr, "\r\033[K{}", text);
  std::fflush(stderr);
  shown_ = true;
}

double StatusLine::seconds() const {
  return std::chrono::duration<double>(Clock::now() - started_).count();
}

}  // namespace stormproof::cli
