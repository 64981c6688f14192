// Starts cvc5, reads what it prints until it ends or its time is over, and turns the lines into
// answers.
#include "checker/engines/smt/second_solver.hpp"

#include <algorithm>
#include <cerrno>
#include <csignal>
#include <cstring>
#include <optional>
#include <sstream>

#include <fcntl.h>
#include <poll.h>
#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>

namespace stormproof::smt {
namespace {

using Clock = std::chrono::steady_clock;

struct Output {
  std::string text;
  std::string failure;  ///< empty: the program ended by itself with status 0
};

/// Starts the program with its standard output into `write_end`. Returns the error, if any.
std::optional<int> start(const std::vector<std::string>& arguments, int write_end, pid_t& child) {
  std::vector<char*> argv;
  for (const std::string& argument : arguments) argv.push_back(const_cast<char*>(argument.c_str()));
  argv.push_back(nullptr);
  posix_spawn_file_actions_t actions;
  posix_spawn_file_actions_init(&actions);
  posix_spawn_file_actions_addopen(&actions, STDIN_FILENO, "/dev/null", O_RDONLY, 0);
  posix_spawn_file_actions_adddup2(&actions, write_end, STDOUT_FILENO);
  posix_spawn_file_actions_addopen(&actions, STDERR_FILENO, "/dev/null", O_WRONLY, 0);
  const int error = posix_spawnp(&child, argv[0], &actions, nullptr, argv.data(), environ);
  posix_spawn_file_actions_destroy(&actions);
  return error == 0 ? std::nullopt : std::optional{error};
}

/// Reads until the end or the deadline. Returns false at the deadline.
bool read_until(int read_end, Clock::time_point deadline, std::string& text) {
  constexpr std::size_t largest_output = 1 << 24;
  char buffer[4096];
  while (text.size() < largest_output) {
    const auto left =
        std::chrono::duration_cast<std::chrono::milliseconds>(deadline - Clock::now()).count();
    if (left <= 0) return false;
    pollfd ready{read_end, POLLIN, 0};
    const int polled = poll(&ready, 1, static_cast<int>(std::min<long long>(left, 1000)));
    if (polled == 0 || (polled < 0 && errno == EINTR)) continue;
    const ssize_t count = polled < 0 ? -1 : read(read_end, buffer, sizeof buffer);
    if (count < 0 && errno == EINTR) continue;
    if (count <= 0) return true;
    text.append(buffer, static_cast<std::size_t>(count));
  }
  return false;
}

Output run(const std::vector<std::string>& arguments, std::chrono::milliseconds limit) {
  Output output;
  int ends[2];
  if (pipe2(ends, O_CLOEXEC) != 0) {
    output.failure = std::string{"no pipe: "} + std::strerror(errno);
    return output;
  }
  pid_t child = -1;
  const auto error = start(arguments, ends[1], child);
  close(ends[1]);
  if (error) {
    close(ends[0]);
    output.failure = "cannot be started: " + std::string{std::strerror(*error)};
    return output;
  }
  const bool ended = read_until(ends[0], Clock::now() + limit, output.text);
  close(ends[0]);
  if (!ended) kill(child, SIGKILL);
  int status = 0;
  while (waitpid(child, &status, 0) < 0 && errno == EINTR) {
  }
  if (!ended) {
    output.failure = "was stopped after its time-out";
  } else if (WIFSIGNALED(status)) {
    output.failure = "ended by signal " + std::to_string(WTERMSIG(status));
  } else if (WIFEXITED(status) && WEXITSTATUS(status) != 0) {
    output.failure = "exit status " + std::to_string(WEXITSTATUS(status));
  }
  return output;
}

std::optional<Answer> answer_in(const std::string& line) {
  if (line == "sat") return Answer::sat;
  if (line == "unsat") return Answer::unsat;
  if (line == "unknown") return Answer::unknown;
  return std::nullopt;
}

}  // namespace

std::string second_solver_name() {
  const Output output = run({"cvc5", "--version"}, std::chrono::seconds{10});
  const std::string prefix = "cvc5 version ";
  const auto begin = output.text.find(prefix);
  if (!output.failure.empty()) return {};
  if (begin == std::string::npos) return "cvc5";
  const auto first = begin + prefix.size();
  return "cvc5 " + output.text.substr(first, output.text.find_first_of(" \n", first) - first);
}

SolverRun ask_second_solver(const std::string& path, std::size_t questions,
                            std::chrono::milliseconds timeout, unsigned seed) {
  // The time-out per query is the solver's own; should it ignore it, it is stopped a little later.
  const auto all = timeout * (static_cast<long long>(questions) + 1) + std::chrono::seconds{2};
  const Output output =
      run({"cvc5", "--lang=smt2", "--incremental", "--seed=" + std::to_string(seed),
           "--tlimit-per=" + std::to_string(timeout.count()), path},
          all);
  SolverRun result;
  result.failure = output.failure;
  std::istringstream lines{output.text};
  for (std::string line; std::getline(lines, line);) {
    if (const auto answer = answer_in(line)) {
      result.answers.push_back(*answer);
    } else if (!line.empty() && result.failure.empty()) {
      result.failure = line.substr(0, 200);
    }
  }
  return result;
}

}  // namespace stormproof::smt
