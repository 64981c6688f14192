// Threads that take the next job until none is left.
#include "checker/experiments/sweep/sweep.hpp"

#include "checker/experiments/trials/parallel.hpp"

namespace stormproof::sweep {

void run_here(const Plan& plan, std::size_t threads, Collector& collector) {
  const std::vector<std::size_t>& jobs = collector.open_jobs();
  if (collector.stopped()) return;
  checker::parallel_for(jobs.size(), threads, [&](std::size_t k) {
    std::optional<Outcome> outcome =
        run(plan.scenario(jobs[k]), [&collector] { return !collector.tick(); });
    return outcome && collector.add(jobs[k], *std::move(outcome));
  });
  collector.finish();
}

}  // namespace stormproof::sweep
