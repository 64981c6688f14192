// One job for each run.
#include "checker/evidence/validate/predicted_runs.hpp"

#include <algorithm>
#include <optional>
#include <random>

#include "checker/evidence/validate/message_tally.hpp"
#include "checker/experiments/trials/losses.hpp"
#include "model/implementations.hpp"

namespace stormproof::validate {

bool is_drawn(const model::Scenario& scenario, const CapturedDeployment& deployment, double loss) {
  if (loss > 0 || model::is_drawn(scenario)) return true;
  if (!model::traits_of(scenario.dds).creates_endpoints_over_time) return false;
  return std::ranges::any_of(deployment.participants, [](const CapturedParticipant& one) {
    return one.done_earliest() < one.done_latest();
  });
}

model::Scenario draw(const model::Scenario& scenario, const CapturedDeployment& deployment,
                     double loss, std::uint64_t seed) {
  model::Scenario drawn = scenario;
  model::draw(drawn, seed);
  std::mt19937_64 random{seed};  // its sequence is fixed by the standard; distributions are not
  for (std::size_t k = 0; k < deployment.participants.size(); ++k) {
    const CapturedParticipant& one = deployment.participants[k];
    const auto values =
        static_cast<std::uint64_t>((one.done_latest() - one.done_earliest()).count()) + 1;
    drawn.deployment.participants[k].endpoints_done =
        one.done_earliest() + model::Nanoseconds{static_cast<std::int64_t>(random() % values)};
  }
  if (loss > 0) drawn.wireless.lost_packets = trials::draw_losses(loss, seed);
  return drawn;
}

Predicted predict(const model::Scenario& scenario, const Observation& observation,
                  const Sampling& sampling) {
  Predicted predicted;
  const bool drawn = is_drawn(scenario, observation.deployment, sampling.loss);
  predicted.wanted = drawn ? sampling.samples : std::min<std::size_t>(sampling.samples, 1);
  trials::Runner runner{sampling.threads, sampling.on_progress};
  const auto run_sample = [&](std::size_t k) -> std::optional<PredictedRun> {
    const std::uint64_t seed = sampling.first_seed + k;
    MessageTally tally{scenario.dds, observation.growth.step_ns, most_growth * observed_steps};
    const auto result =
        runner.simulate(draw(scenario, observation.deployment, sampling.loss, seed), &tally);
    if (!result) return std::nullopt;
    PredictedRun run;
    run.seed = seed;
    run.complete = result->completed();
    run.shares = shares_of(*result);
    run.tally = tally.tally();
    if (run.complete) {
      run.tally[index_of(Figure::completion)] =
          static_cast<std::uint64_t>(result->discovery_time->count());
      if (observation.cut == Cut::last_initial) run.tally = tally.at_last_initial();
    }
    if (k == 0) predicted.sizes = tally.sizes();
    run.growth = std::move(tally).finish();
    return run;
  };
  predicted.runs = trials::present(runner.run(predicted.wanted, run_sample));
  return predicted;
}

}  // namespace stormproof::validate
