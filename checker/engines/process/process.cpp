// posix_spawn, a pipe, and a clock.
#include "checker/engines/process/process.hpp"

#include <algorithm>
#include <cerrno>
#include <csignal>
#include <cstring>

#include <fcntl.h>
#include <poll.h>
#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>

namespace stormproof::process {
namespace {

using Clock = std::chrono::steady_clock;

/// A group of its own, and signals as if nobody had ignored or blocked them.
void set_attributes(posix_spawnattr_t& attributes) {
  posix_spawnattr_init(&attributes);
  sigset_t signals;
  sigemptyset(&signals);
  posix_spawnattr_setsigmask(&attributes, &signals);
  for (const int signal : {SIGINT, SIGTERM, SIGPIPE, SIGXFSZ}) sigaddset(&signals, signal);
  posix_spawnattr_setsigdefault(&attributes, &signals);
  posix_spawnattr_setpgroup(&attributes, 0);
  posix_spawnattr_setflags(&attributes,
                           POSIX_SPAWN_SETSIGMASK | POSIX_SPAWN_SETSIGDEF | POSIX_SPAWN_SETPGROUP);
}

/// Starts the program with its output into `write_end`. Returns 0 or the error.
int start(const Program& program, int write_end, pid_t& child) {
  std::vector<char*> argv;
  for (const std::string& argument : program.arguments) {
    argv.push_back(const_cast<char*>(argument.c_str()));
  }
  argv.push_back(nullptr);
  posix_spawn_file_actions_t actions;
  posix_spawn_file_actions_init(&actions);
  posix_spawn_file_actions_addopen(&actions, STDIN_FILENO, "/dev/null", O_RDONLY, 0);
  posix_spawn_file_actions_adddup2(&actions, write_end, STDOUT_FILENO);
  if (program.errors) {
    posix_spawn_file_actions_adddup2(&actions, write_end, STDERR_FILENO);
  } else {
    posix_spawn_file_actions_addopen(&actions, STDERR_FILENO, "/dev/null", O_WRONLY, 0);
  }
  if (!program.folder.empty()) {
    posix_spawn_file_actions_addchdir_np(&actions, program.folder.c_str());
  }
  posix_spawnattr_t attributes;
  set_attributes(attributes);
  const int error = posix_spawnp(&child, argv[0], &actions, &attributes, argv.data(), environ);
  posix_spawnattr_destroy(&attributes);
  posix_spawn_file_actions_destroy(&actions);
  return error;
}

constexpr std::size_t largest_output = 1 << 24;

/// How often `stop` is asked.
constexpr long long glance_milliseconds = 50;

/// Reads until the end. Returns false if something else comes first: the deadline, the largest
/// output, or that the program is to stop.
bool read_until(int read_end, Clock::time_point deadline, const std::function<bool()>& stop,
                std::string& text) {
  char buffer[4096];
  const long long most = stop ? glance_milliseconds : 1000;
  while (text.size() < largest_output && !(stop && stop())) {
    const auto left =
        std::chrono::duration_cast<std::chrono::milliseconds>(deadline - Clock::now()).count();
    if (left <= 0) return false;
    pollfd ready{read_end, POLLIN, 0};
    const int polled = poll(&ready, 1, static_cast<int>(std::min<long long>(left, most)));
    if (polled == 0 || (polled < 0 && errno == EINTR)) continue;
    const ssize_t count = polled < 0 ? -1 : read(read_end, buffer, sizeof buffer);
    if (count < 0 && errno == EINTR) continue;
    if (count <= 0) return true;
    text.append(buffer, static_cast<std::size_t>(count));
  }
  return false;
}

}  // namespace

Run run(const Program& program) {
  Run result;
  int ends[2];
  if (pipe2(ends, O_CLOEXEC) != 0) {
    result.failure = std::string{"no pipe: "} + std::strerror(errno);
    return result;
  }
  pid_t child = -1;
  const int error = start(program, ends[1], child);
  close(ends[1]);
  if (error != 0) {
    close(ends[0]);
    result.failure = std::string{"cannot be started: "} + std::strerror(error);
    return result;
  }
  const bool ended = read_until(ends[0], Clock::now() + program.limit, program.stop, result.output);
  close(ends[0]);
  if (!ended) kill(-child, SIGKILL);
  int status = 0;
  while (waitpid(child, &status, 0) < 0 && errno == EINTR) {
  }
  if (!ended) {
    result.failure = program.stop && program.stop()          ? "interrupted"
                     : result.output.size() < largest_output ? "was stopped after its time-out"
                                                             : "printed more than 16 MB";
  } else if (WIFSIGNALED(status)) {
    result.failure = "ended by signal " + std::to_string(WTERMSIG(status));
  } else {
    result.status = WEXITSTATUS(status);
  }
  return result;
}

}  // namespace stormproof::process
