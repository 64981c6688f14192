// The one runner of many runs: independent jobs (a scenario under a seed, mostly) on all cores of
// one machine, with progress and interruption. Results stand in the order of the jobs, whichever
// thread was faster, so no answer depends on the number of threads. What a caller has kept from an
// earlier call (samples, a database) is resumed by giving only the jobs that are left.
#pragma once

#include <atomic>
#include <cstddef>
#include <functional>
#include <mutex>
#include <optional>
#include <string_view>
#include <utility>
#include <vector>

#include "model/run_result.hpp"
#include "model/scenario.hpp"

namespace stormproof::model {
class Probe;
}

namespace stormproof::trials {

/// Told how many jobs are finished, of how many; returning false stops all. Called by one thread at
/// a time, after each job and now and then within one; `finished` never decreases.
using Progress = std::function<bool(std::size_t finished, std::size_t all)>;

/// The same for a study: what it is doing, its runs so far, and about how many in all.
using StudyProgress =
    std::function<bool(std::string_view doing, std::size_t runs, std::size_t about)>;

/// As many as the machine has cores, at least one.
[[nodiscard]] std::size_t core_count();

class Runner {
 public:
  /// `threads` 0: one for each core; the calling thread is one of them. `finished`: jobs that were
  /// done before, which progress counts too.
  explicit Runner(std::size_t threads = 0, Progress on_progress = {}, std::size_t finished = 0);

  /// Calls `job(k)` for each k from 0 to count − 1, started in this order. A job that returns false
  /// starts no further ones; those that run finish. Returns whether all of them returned true and
  /// nobody stopped the runner; a stopped runner starts none. Jobs must not throw. Not to be called
  /// by a job.
  bool each(std::size_t count, const std::function<bool(std::size_t k)>& job);

  /// The results of `job(k)`, a std::optional, in the order of k. Absent are those of jobs that
  /// were interrupted, which starts no further ones, or never started.
  template <class Job>
  [[nodiscard]] auto run(std::size_t count, const Job& job) {
    std::vector<decltype(job(std::size_t{}))> results(count);
    each(count, [&](std::size_t k) {
      results[k] = job(k);
      return results[k].has_value();
    });
    return results;
  }

  /// To be asked by jobs now and then, from any thread: whether to go on.
  [[nodiscard]] bool goes_on();

  /// One run of the simulator that asks so; nothing if it was stopped. `probe` may be null.
  [[nodiscard]] std::optional<model::RunResult> simulate(const model::Scenario& scenario,
                                                         model::Probe* probe = nullptr);

  /// Whether progress said no.
  [[nodiscard]] bool stopped() const { return stopped_; }
  /// Jobs that returned true, by all calls.
  [[nodiscard]] std::size_t finished() const { return finished_; }

 private:
  bool report();

  std::size_t threads_;
  Progress on_progress_;
  std::mutex mutex_;
  std::atomic<std::size_t> finished_;
  std::size_t all_;
  std::atomic<bool> stopped_ = false;
};

/// The results that are there, in their order.
template <class Result>
[[nodiscard]] std::vector<Result> present(std::vector<std::optional<Result>> results) {
  std::vector<Result> there;
  for (std::optional<Result>& result : results) {
    if (result) there.push_back(*std::move(result));
  }
  return there;
}

}  // namespace stormproof::trials
