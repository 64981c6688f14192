// The outcomes go to the collector, which keeps them for the next sweep.
#include "checker/experiments/sweep/sweep.hpp"

#include "checker/experiments/trials/runner.hpp"

namespace stormproof::sweep {

void run_here(const Plan& plan, std::size_t threads, Collector& collector) {
  const std::vector<std::size_t>& jobs = collector.open_jobs();
  if (collector.stopped()) return;
  // The collector asks for progress itself: a job counts when it is committed.
  trials::Runner{threads}.each(jobs.size(), [&](std::size_t k) {
    std::optional<Outcome> outcome =
        run(plan.scenario(jobs[k]), [&collector] { return !collector.tick(); });
    return outcome && collector.add(jobs[k], *std::move(outcome));
  });
  collector.finish();
}

}  // namespace stormproof::sweep
