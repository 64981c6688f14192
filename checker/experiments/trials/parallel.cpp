// One counter that all threads take their jobs from.
#include "checker/experiments/trials/parallel.hpp"

#include <algorithm>
#include <atomic>
#include <thread>
#include <vector>

namespace stormproof::checker {

std::size_t core_count() { return std::max(1U, std::thread::hardware_concurrency()); }

bool parallel_for(std::size_t count, std::size_t threads,
                  const std::function<bool(std::size_t)>& job) {
  std::atomic<std::size_t> next = 0;
  std::atomic<bool> stopped = false;
  const auto work = [&] {
    for (std::size_t k = next++; k < count && !stopped; k = next++) {
      if (!job(k)) stopped = true;
    }
  };
  std::vector<std::thread> others;
  for (std::size_t k = 1; k < std::min(threads == 0 ? core_count() : threads, count); ++k) {
    others.emplace_back(work);
  }
  work();
  for (std::thread& thread : others) thread.join();
  return !stopped;
}

}  // namespace stormproof::checker
