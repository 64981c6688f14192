// Runs one job and meters it.
#include "checker/experiments/sweep/outcome.hpp"

#include <algorithm>
#include <chrono>
#include <ctime>
#include <new>

#include "model/reference.hpp"
#include "model/simulator.hpp"

namespace stormproof::sweep {

namespace {

double thread_cpu_seconds() {
  timespec time{};
  clock_gettime(CLOCK_THREAD_CPUTIME_ID, &time);
  return static_cast<double>(time.tv_sec) + static_cast<double>(time.tv_nsec) / 1e9;
}

std::int64_t number(std::uint64_t value) { return static_cast<std::int64_t>(value); }

std::optional<std::int64_t> number(const std::optional<model::Nanoseconds>& time) {
  return time ? std::optional{time->count()} : std::nullopt;
}

void fill(Outcome& outcome, const model::Scenario& scenario, const model::RunResult& result) {
  std::uint64_t peak_backlog = 0;
  for (const model::BacklogPeak& peak : result.backlog) {
    peak_backlog = std::max(peak_backlog, peak.packets);
  }
  const model::Counts& counts = result.counts;
  outcome.end = name_of(result.end);
  outcome.numbers = {
      number(result.discovery_time),
      number(counts.initial_data),
      number(counts.repair_data),
      number(counts.heartbeat),
      number(counts.acknack),
      number(counts.spdp_multicast),
      number(counts.spdp_unicast),
      number(counts.total()),
      number(result.user_control),
      number(counts.lookup),
      result.end_time.count(),
      number(result.events),
      number(result.missing_count),
      number(peak_backlog),
      number(model::open_loop_airtime(scenario)),
      number(model::failure_free_reference(scenario).total()),
  };
}

}  // namespace

Outcome failure(std::string error) {
  Outcome outcome;
  outcome.end = "error";
  outcome.error = std::move(error);
  return outcome;
}

std::optional<Outcome> run(const model::Scenario& scenario, const std::function<bool()>& stop) {
  using Clock = std::chrono::steady_clock;
  Outcome outcome;
  const Clock::time_point started = Clock::now();
  const double cpu_before = thread_cpu_seconds();
  try {
    model::RunOptions options;
    options.on_progress = [&](const model::Progress&) { return !stop(); };
    const model::RunResult result = model::simulate(scenario, options);
    if (result.end == model::RunEnd::interrupted) return std::nullopt;
    fill(outcome, scenario, result);
    outcome.cpu_seconds = thread_cpu_seconds() - cpu_before;
    outcome.wall_seconds = std::chrono::duration<double>(Clock::now() - started).count();
  } catch (const std::bad_alloc&) {
    outcome = failure("out of memory; expected a smaller deployment or fewer jobs at a time");
  }
  return outcome;
}

}  // namespace stormproof::sweep
