// The same sweep on several machines, under `mpirun`. Every rank reads the same grid; rank 0 looks
// up what is done, hands out one job after the other, and is the only one who writes. If a rank
// dies, mpirun ends all of them, and the next sweep goes on from what rank 0 had committed. All
// that the program knows of MPI is in here; without mpirun it is never initialised.
#pragma once

#include <optional>
#include <string>

#include "checker/experiments/sweep/collector.hpp"

namespace stormproof::sweep {

/// How the program was started, as the environment says before MPI is initialised.
struct Launch {
  int ranks = 1;  ///< 1 also without mpirun
  int rank = 0;
};
[[nodiscard]] Launch launch();

/// MPI, from now on until the end of its life. Only with a `Launch` of several ranks.
class MpiWorld {
 public:
  MpiWorld();
  ~MpiWorld();
  MpiWorld(const MpiWorld&) = delete;
  MpiWorld& operator=(const MpiWorld&) = delete;

  /// Why this program cannot take part: it was built without MPI, or with another one than
  /// mpirun's.
  [[nodiscard]] const std::optional<std::string>& error() const { return error_; }

  /// Whether all ranks have the same plan (rank 0's is what counts). Called by all of them.
  [[nodiscard]] bool agree_on(const Plan& plan) const;
  /// Rank 0: hands out the jobs, as `run_here` does to threads. Tells the others when it is over,
  /// also if there is nothing to do.
  void distribute(Collector& collector) const;
  /// Rank 0, instead of `distribute`: there is nothing to run after all.
  void dismiss() const;
  /// The other ranks: run what they are given, until it is over. `interrupted` is asked now and
  /// then.
  void work(const Plan& plan, const std::function<bool()>& interrupted) const;

 private:
  std::optional<std::string> error_;
  int ranks_ = 1;
  bool initialised_ = false;
};

}  // namespace stormproof::sweep
