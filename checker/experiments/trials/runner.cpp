// One counter that all threads take their jobs from, and one lock around progress.
#include "checker/experiments/trials/runner.hpp"

#include <algorithm>
#include <thread>

#include "model/simulator.hpp"

namespace stormproof::trials {

std::size_t core_count() { return std::max(1U, std::thread::hardware_concurrency()); }

Runner::Runner(std::size_t threads, Progress on_progress, std::size_t finished)
    : threads_{threads == 0 ? core_count() : threads},
      on_progress_{std::move(on_progress)},
      finished_{finished},
      all_{finished} {}

bool Runner::each(std::size_t count, const std::function<bool(std::size_t k)>& job) {
  all_ += count;
  std::atomic<std::size_t> next = 0;
  std::atomic<bool> failed = false;
  const auto work = [&] {
    for (std::size_t k = next++; k < count && !failed && !stopped_; k = next++) {
      if (!job(k)) {
        failed = true;
        continue;
      }
      const std::lock_guard lock{mutex_};
      ++finished_;
      report();
    }
  };
  std::vector<std::thread> others;
  for (std::size_t k = 1; k < std::min(threads_, count); ++k) others.emplace_back(work);
  work();
  for (std::thread& thread : others) thread.join();
  return !failed && !stopped_;
}

/// Under the lock.
bool Runner::report() {
  if (!stopped_ && on_progress_ && !on_progress_(finished_, all_)) stopped_ = true;
  return !stopped_;
}

bool Runner::goes_on() {
  // Whoever holds the lock asks for all.
  if (const std::unique_lock lock{mutex_, std::try_to_lock}; lock) return report();
  return !stopped_;
}

std::optional<model::RunResult> Runner::simulate(const model::Scenario& scenario,
                                                 model::Probe* probe) {
  model::RunOptions options;
  options.probe = probe;
  options.on_progress = [this](const model::Progress&) { return goes_on(); };
  model::RunResult result = model::simulate(scenario, options);
  if (result.end == model::RunEnd::interrupted) return std::nullopt;
  return result;
}

}  // namespace stormproof::trials
