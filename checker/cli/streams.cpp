// The C streams: they remember that a write failed, and the descriptors below them.
#include "checker/cli/streams.hpp"

#include <atomic>
#include <cerrno>
#include <csignal>
#include <cstdio>
#include <cstring>
#include <mutex>

#include <fcntl.h>
#include <unistd.h>

namespace stormproof::cli {

namespace {

std::atomic<Diversion*> diversion = nullptr;
std::mutex saying;  // a progress line may be said by another thread

int output_errno = 0;  // of the first write that failed

void note_failure() {
  if (std::ferror(stdout) != 0 && output_errno == 0) output_errno = errno;
}

}  // namespace

void prepare_streams() {
  // The lowest free descriptor is taken; opened the wrong way round, it refuses what is written.
  for (const int descriptor : {STDIN_FILENO, STDOUT_FILENO, STDERR_FILENO}) {
    if (fcntl(descriptor, F_GETFD) >= 0 || errno != EBADF) continue;
    (void)open("/dev/null", descriptor == STDIN_FILENO ? O_WRONLY : O_RDONLY);
  }
  std::signal(SIGPIPE, SIG_IGN);
  std::signal(SIGXFSZ, SIG_IGN);
}

Diversion::Diversion() { diversion = this; }

Diversion::~Diversion() { diversion = nullptr; }

void print(std::string_view text) {
  if (Diversion* kept = diversion) {
    kept->printed += text;
    return;
  }
  std::fwrite(text.data(), 1, text.size(), stdout);
  note_failure();
}

void mutter(std::string_view text) {
  if (Diversion* kept = diversion) {
    const std::lock_guard lock{saying};
    kept->said += text;
    return;
  }
  std::fwrite(text.data(), 1, text.size(), stderr);
  std::fflush(stderr);
}

void say(const std::string& line) { mutter(line + "\n"); }

std::optional<std::string> output_lost() {
  note_failure();
  if (std::fflush(stdout) != 0) note_failure();
  if (std::ferror(stdout) == 0) return std::nullopt;
  if (output_errno == EPIPE) return "";
  return std::string{"standard output: could not be written completely"} +
         (output_errno == 0 ? std::string{} : std::string{": "} + std::strerror(output_errno));
}

}  // namespace stormproof::cli
