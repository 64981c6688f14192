// Distributes the sampled runs over threads.
#include "checker/experiments/trials/sample_runs.hpp"

#include <mutex>

#include "checker/experiments/trials/parallel.hpp"
#include "model/simulator.hpp"

namespace stormproof::sampling {

namespace {

class Pool {
 public:
  Pool(const model::Scenario& scenario, const SampleOptions& options)
      : scenario_{scenario}, options_{options}, results_(options.samples) {}

  std::vector<Sample> run() {
    checker::parallel_for(options_.samples, options_.threads,
                          [this](std::size_t k) { return run_sample(k); });
    std::vector<Sample> finished;
    for (auto& result : results_) {
      if (result) finished.push_back(*result);
    }
    return finished;
  }

 private:
  bool run_sample(std::size_t k) {
    model::Scenario scenario = scenario_;
    const std::uint64_t seed = options_.first_seed + k;
    if (scenario.deployment.schedule) scenario.deployment.draw_schedule(seed);
    model::RunOptions run_options;
    run_options.on_progress = [this](const model::Progress&) { return report(0); };
    const model::RunResult run = model::simulate(scenario, run_options);
    if (run.end == model::RunEnd::interrupted) return false;
    results_[k] =
        Sample{seed, run.end, run.discovery_time, run.counts, run.user_control, run.events};
    return report(1);
  }

  bool report(std::size_t newly_finished) {
    const std::lock_guard lock{mutex_};
    finished_ += newly_finished;
    if (options_.on_progress && !options_.on_progress(finished_)) stopped_ = true;
    return !stopped_;
  }

  const model::Scenario& scenario_;
  const SampleOptions& options_;
  std::vector<std::optional<Sample>> results_;
  bool stopped_ = false;
  std::mutex mutex_;
  std::size_t finished_ = 0;
};

}  // namespace

std::vector<Sample> sample_runs(const model::Scenario& scenario, const SampleOptions& options) {
  return Pool{scenario, options}.run();
}

}  // namespace stormproof::sampling
