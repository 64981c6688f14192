// One job for each schedule.
#include "checker/experiments/trials/sample_runs.hpp"

#include "checker/experiments/trials/under_seed.hpp"

namespace stormproof::trials {

std::vector<Sample> sample_runs(const model::Scenario& scenario, const SampleOptions& options) {
  Runner runner{options.threads, options.on_progress};
  return present(runner.run(options.samples, [&](std::size_t k) -> std::optional<Sample> {
    const std::uint64_t seed = options.first_seed + k;
    const model::Scenario drawn = under_seed(scenario, seed, options.start_jitter);
    const auto run = runner.simulate(drawn);
    if (!run) return std::nullopt;
    return Sample{seed,
                  run->end,
                  run->discovery_time,
                  run->counts,
                  run->user_control,
                  run->events,
                  exact::health_of(drawn, *run)};
  }));
}

}  // namespace stormproof::trials
