// Signal handling and the progress line.
#include "checker/cli/run_monitor.hpp"

#include <csignal>
#include <cstdio>

#include <fmt/core.h>

#include "checker/presentation/text/numbers.hpp"

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

void ProgressLine::update(const model::Progress& progress) {
  if (!line_.due()) return;
  const auto delivered = static_cast<double>(progress.required - progress.missing);
  const auto events = static_cast<double>(progress.events);
  line_.show(fmt::format("simulated {}, {} of descriptors delivered, {} events, {:.1f} M/s",
                         report::duration(progress.now),
                         report::percent(delivered, static_cast<double>(progress.required)),
                         report::grouped(progress.events), events / line_.seconds() / 1e6));
}

void SampleProgressLine::update(std::size_t finished) {
  if (!line_.due()) return;
  const double rate = static_cast<double>(finished) / line_.seconds();
  const double rest = rate > 0 ? static_cast<double>(runs_ - finished) / rate : 0;
  line_.show(fmt::format("{} of {} runs, about {:.0f} s left", finished, runs_, rest));
}

}  // namespace stormproof::cli
