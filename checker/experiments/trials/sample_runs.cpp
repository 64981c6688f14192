// One job for each schedule.
#include "checker/experiments/trials/sample_runs.hpp"

#include "checker/experiments/trials/under_seed.hpp"

namespace stormproof::trials {

std::optional<Sample> sample_run(Runner& runner, const model::Scenario& scenario,
                                 std::uint64_t seed, model::Nanoseconds start_jitter,
                                 const std::optional<launch::Plan>& plan) {
  model::Scenario drawn = under_seed(scenario, seed, start_jitter);
  if (plan) launch::follow(*plan, scenario.deployment, drawn);
  const auto run = runner.simulate(drawn);
  if (!run) return std::nullopt;
  return Sample{seed,
                run->end,
                run->discovery_time,
                run->counts,
                run->user_control,
                run->events,
                exact::health_of(drawn, *run)};
}

std::vector<Sample> sample_runs(const model::Scenario& scenario, const SampleOptions& options) {
  Runner runner{options.threads, options.on_progress};
  return present(runner.run(options.samples, [&](std::size_t k) {
    return sample_run(runner, scenario, options.first_seed + k, options.start_jitter);
  }));
}

}  // namespace stormproof::trials
