// Signal handling and the progress line.
#include "checker/cli/run_monitor.hpp"

#include <algorithm>
#include <atomic>
#include <cstdint>

#include <fmt/core.h>
#include <poll.h>
#include <sys/eventfd.h>
#include <sys/signalfd.h>
#include <unistd.h>

#include "checker/cli/complain.hpp"
#include "checker/cli/memory_limit.hpp"
#include "checker/cli/output_file.hpp"
#include "checker/cli/streams.hpp"
#include "checker/cli/terminal.hpp"

namespace stormproof::cli {

namespace {

using Clock = std::chrono::steady_clock;

/// Why the work is to stop.
enum class Stop : std::uint8_t { no, asked, memory, time };
std::atomic<Stop> stop = Stop::no;

/// When the time of the work is over. Set before any thread looks.
std::optional<Clock::time_point> deadline;

/// The first `columns` characters of `text`, the last of them "…" if there are more.
std::string cut_to(std::string text, std::size_t columns) {
  std::size_t width = 0;
  std::size_t last = 0;  // where the last character that fits begins
  for (std::size_t k = 0; k < text.size(); ++k) {
    if ((static_cast<unsigned char>(text[k]) & 0xC0U) == 0x80U) continue;
    if (++width <= columns) last = k;
  }
  if (width <= columns) return text;
  return columns == 0 ? std::string{} : text.substr(0, last) + "…";
}

/// How often memory is looked at.
constexpr int glance_milliseconds = 50;

sigset_t watched_signals() {
  sigset_t set;
  sigemptyset(&set);
  sigaddset(&set, SIGINT);
  sigaddset(&set, SIGTERM);
  sigaddset(&set, SIGHUP);  // a session that ends; with nohup it is ignored, and never comes
  return set;
}

/// As if nobody had been watching.
[[noreturn]] void end_by(int signal) {
  OutputFile::discard_all();
  std::signal(signal, SIG_DFL);
  const sigset_t set = watched_signals();
  pthread_sigmask(SIG_UNBLOCK, &set, nullptr);
  raise(signal);
  _exit(128 + signal);
}

}  // namespace

InterruptGuard::InterruptGuard(std::optional<double> seconds, Process process) {
  stop = Stop::no;
  deadline.reset();
  if (seconds) {
    const std::chrono::duration<double> allowed{*seconds};
    deadline = Clock::now() + std::chrono::duration_cast<Clock::duration>(allowed);
  }
  if (process == Process::own) {
    const sigset_t set = watched_signals();
    pthread_sigmask(SIG_BLOCK, &set, &before_);
    signals_ = signalfd(-1, &set, SFD_CLOEXEC);
  }
  end_ = eventfd(0, EFD_CLOEXEC);
  watch_ = std::thread{[this] { watch(); }};
}

InterruptGuard::~InterruptGuard() {
  const std::uint64_t one = 1;
  (void)!write(end_, &one, sizeof one);
  watch_.join();
  close(end_);
  if (signals_ < 0) return;
  close(signals_);
  pthread_sigmask(SIG_SETMASK, &before_, nullptr);
}

void InterruptGuard::watch() const {
  pollfd ready[] = {{end_, POLLIN, 0}, {signals_, POLLIN, 0}};
  while (true) {
    const int count = poll(ready, 2, glance_milliseconds);
    if (stop == Stop::no && memory_runs_short()) stop = Stop::memory;
    if (stop == Stop::no && deadline && Clock::now() >= *deadline) stop = Stop::time;
    if (count <= 0) continue;
    if (ready[0].revents != 0) return;
    signalfd_siginfo received{};
    if (read(signals_, &received, sizeof received) != sizeof received) continue;
    if (stop == Stop::asked) end_by(static_cast<int>(received.ssi_signo));
    stop = Stop::asked;
  }
}

void InterruptGuard::interrupt() { stop = Stop::asked; }

bool InterruptGuard::interrupted() { return stop != Stop::no; }

bool InterruptGuard::short_of_memory() { return stop == Stop::memory; }

bool InterruptGuard::out_of_time() { return stop == Stop::time; }

std::optional<double> InterruptGuard::seconds_left() {
  if (!deadline) return std::nullopt;
  return std::max(0.0, std::chrono::duration<double>(*deadline - Clock::now()).count());
}

StatusLine::~StatusLine() {
  if (shown_) mutter("\r\033[K");
}

bool StatusLine::due() {
  if (!enabled_) return false;
  const Clock::time_point now = Clock::now();
  if (now < next_) return false;
  next_ = now + std::chrono::milliseconds{250};
  return true;
}

void StatusLine::show(const std::string& text) {
  // A line that is broken cannot be renewed; the last column stays free for the cursor.
  const auto columns = columns_of_errors();
  mutter("\r\033[K" + (columns ? cut_to(visible(text), *columns - 1) : text));
  shown_ = true;
}

double StatusLine::seconds() const {
  return std::chrono::duration<double>(Clock::now() - started_).count();
}

}  // namespace stormproof::cli
