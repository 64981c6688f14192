// One process of the live bed: waits for the start instant, discovers, reports when it knows
// everything that it expects, and goes on answering the others until it is told to stop. It ends
// without a word to them: disposing of its endpoints would be traffic that no discovery has.
#include <csignal>
#include <cstdio>
#include <cstdlib>
#include <ctime>
#include <exception>
#include <fstream>
#include <stdexcept>
#include <string>

#include "endpoints.hpp"
#include "options.hpp"
#include "participant.hpp"
#include "progress.hpp"

namespace stormproof::live {

namespace {

constexpr std::int64_t ns_per_second = 1'000'000'000;
constexpr int exit_usage = 2;

timespec to_timespec(std::int64_t ns) {
  return {.tv_sec = ns / ns_per_second, .tv_nsec = ns % ns_per_second};
}

/// SIGTERM and SIGINT are waited for, in this thread and no other: call before any thread starts.
sigset_t block_stop_signals() {
  sigset_t signals;
  sigemptyset(&signals);
  sigaddset(&signals, SIGTERM);
  sigaddset(&signals, SIGINT);
  pthread_sigmask(SIG_BLOCK, &signals, nullptr);
  return signals;
}

bool told_to_stop(const sigset_t& signals, std::int64_t wait_ns) {
  const timespec wait = to_timespec(wait_ns);
  return sigtimedwait(&signals, nullptr, &wait) > 0;
}

/// Writes beside the file and renames, so that a reader sees all of it or nothing.
void write_file(const std::string& path, const std::string& text) {
  const std::string partial = path + ".part";
  std::ofstream file(partial);
  file << text;
  file.close();
  if (!file || std::rename(partial.c_str(), path.c_str()) != 0) {
    throw std::runtime_error("cannot write " + path);
  }
}

/// Ends the process if it is told to stop before the start.
void wait_for_start(const Options& options, const sigset_t& signals) {
  constexpr std::int64_t poll_ns = 2'000'000;
  write_file(options.report + ".ready", "");
  std::int64_t start_ns = 0;
  while (!(std::ifstream(options.start_file) >> start_ns)) {
    if (told_to_stop(signals, poll_ns)) {
      std::_Exit(EXIT_SUCCESS);
    }
  }
  sleep_until_ns(start_ns);
}

std::string report(const Options& options, const Schedule& schedule, const Progress& progress) {
  const auto line = [](const char* name, std::int64_t value) {
    return std::string("  \"") + name + "\": " + std::to_string(value);
  };
  return "{\n" + line("host", options.host) + ",\n" + line("index", options.index) + ",\n" +
         line("created_ns", schedule.created_ns) + ",\n" +
         line("endpoints_done_ns", schedule.endpoints_done_ns) + ",\n" +
         line("app_ns", progress.app.reached_ns()) + ",\n" + line("matches", progress.app.count()) +
         ",\n" + line("matches_expected", progress.app.expected()) + ",\n" +
         line("strict_ns", progress.strict.reached_ns()) + ",\n" +
         line("discovered", progress.strict.count()) + ",\n" +
         line("discovered_expected", progress.strict.expected()) + "\n}\n";
}

void run(const Options& options) {
  constexpr std::int64_t poll_ns = 20'000'000;
  const sigset_t signals = block_stop_signals();
  if (options.serves) {
    create_server(options);
    write_file(options.report + ".ready", "");
    while (!told_to_stop(signals, ns_per_second)) {
    }
    return;
  }
  // The library counts until the process ends.
  static Progress progress(expected_matches(options), expected_discoveries(options));
  const Schedule schedule =
      create_participant(options, progress, [&] { wait_for_start(options, signals); });
  while (!progress.is_complete() && !told_to_stop(signals, poll_ns)) {
  }
  write_file(options.report, report(options, schedule, progress));
  if (progress.is_complete()) {
    while (!told_to_stop(signals, ns_per_second)) {
    }
  }
}

}  // namespace

}  // namespace stormproof::live

int main(int argc, char** argv) {
  try {
    stormproof::live::run(stormproof::live::parse_options(argc, argv));
  } catch (const std::invalid_argument& problem) {
    std::fprintf(stderr, "participant: %s\n", problem.what());
    return stormproof::live::exit_usage;
  } catch (const std::exception& problem) {
    std::fprintf(stderr, "participant: %s\n", problem.what());
    return EXIT_FAILURE;
  }
  std::_Exit(EXIT_SUCCESS);
}
