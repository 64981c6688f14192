// Spreads independent jobs over the cores of one machine: samples of a prediction, cases of a fuzz
// run, rows of a sweep.
#pragma once

#include <cstddef>
#include <functional>

namespace stormproof::checker {

/// As many as the machine has cores, at least one.
[[nodiscard]] std::size_t core_count();

/// Calls `job(k)` for each k from 0 to count - 1, in this order of starting, on `threads` threads
/// (0: one for each core; the calling thread is one of them). A job that returns false starts no
/// further ones; those that run finish. Returns whether all jobs ran and returned true. Jobs must
/// not throw.
bool parallel_for(std::size_t count, std::size_t threads,
                  const std::function<bool(std::size_t)>& job);

}  // namespace stormproof::checker
