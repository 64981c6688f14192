// Runs the jobs that a collector has left, on the cores of this machine. `mpi_ranks.hpp` does the
// same on those of several.
#pragma once

#include <cstddef>

#include "checker/experiments/sweep/collector.hpp"

namespace stormproof::sweep {

/// Returns when all jobs are done or the sweep is stopped. `threads`: 0 for one each core.
void run_here(const Plan& plan, std::size_t threads, Collector& collector);

}  // namespace stormproof::sweep
