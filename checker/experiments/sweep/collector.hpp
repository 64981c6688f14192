// Where the outcomes of a sweep arrive, from whatever runs the jobs: they go into the database in
// groups, and stay in memory for the tables. A job counts as finished when it is committed.
#pragma once

#include <atomic>
#include <chrono>
#include <functional>
#include <mutex>
#include <optional>
#include <string>
#include <vector>

#include "checker/experiments/grids/plan.hpp"
#include "checker/experiments/sweep/database.hpp"

namespace stormproof::sweep {

using grids::Plan;

/// How far a sweep is.
struct Status {
  std::size_t jobs = 0;
  std::size_t already_done = 0;  ///< found in the database
  std::size_t finished = 0;      ///< by this sweep, committed
};

class Collector {
 public:
  /// Most jobs of one commit.
  static constexpr std::size_t group = 1024;
  /// How long a job that is done waits for a commit: as long as a hundred commits take, so that
  /// they do not slow down a sweep of short jobs, but not longer than this.
  static constexpr std::chrono::milliseconds shortest_patience{50}, longest_patience{500};

  /// Looks up what is done, and enters the jobs that cannot run. `on_progress` is called from one
  /// thread at a time, after each commit and now and then in between; returning false stops the
  /// sweep.
  Collector(const Plan& plan, Database& database, std::function<bool(const Status&)> on_progress);

  /// The jobs that are left, in the order of the plan; one of those that are alike.
  [[nodiscard]] const std::vector<std::size_t>& open_jobs() const { return open_; }

  /// Takes the outcome of an open job; from any thread. Returns whether to go on.
  bool add(std::size_t job, Outcome outcome);
  /// To be called now and then while jobs run, from any thread. Returns whether to go on.
  bool tick();
  /// Commits the rest.
  void finish();
  void stop() { stopped_ = true; }

  [[nodiscard]] const Status& status() const { return status_; }
  /// Whether somebody stopped the sweep.
  [[nodiscard]] bool stopped() const { return stopped_; }
  /// What went wrong with the database, if anything; the sweep is stopped then.
  [[nodiscard]] const std::optional<std::string>& error() const { return error_; }
  /// Of the simulations of this sweep, all threads.
  [[nodiscard]] double cpu_seconds() const { return cpu_seconds_; }
  /// The outcome of any job of the plan, null if it is not done.
  [[nodiscard]] const Outcome* outcome(std::size_t job) const;

 private:
  using Clock = std::chrono::steady_clock;

  void enter(std::size_t job, Outcome outcome);
  void commit();
  void report();

  const Plan& plan_;
  Database& database_;
  std::function<bool(const Status&)> on_progress_;
  std::vector<std::size_t> open_;
  std::vector<std::optional<Outcome>> outcomes_;  ///< by job; of those alike only the first
  std::mutex mutex_;
  std::atomic<bool> stopped_ = false;
  Status status_;
  std::size_t pending_ = 0;          ///< rows since the last commit
  std::size_t pending_jobs_ = 0;     ///< jobs that they stand for
  Clock::time_point pending_since_;  ///< when the first of them came
  Clock::duration patience_ = shortest_patience;
  std::vector<std::size_t> alike_;  ///< by job, how many are the same run
  double cpu_seconds_ = 0;
  std::optional<std::string> error_;
};

}  // namespace stormproof::sweep
