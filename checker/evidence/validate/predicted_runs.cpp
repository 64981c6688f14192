// One job for each run.
#include "checker/evidence/validate/predicted_runs.hpp"

#include <algorithm>
#include <mutex>
#include <optional>
#include <random>

#include "checker/evidence/coverage/predict.hpp"
#include "checker/evidence/validate/message_tally.hpp"
#include "checker/experiments/trials/parallel.hpp"
#include "model/simulator.hpp"

namespace stormproof::validate {

namespace {

class Pool {
 public:
  Pool(const model::Scenario& scenario, const Observation& observation, const Sampling& sampling)
      : scenario_{scenario}, observation_{observation}, sampling_{sampling} {
    const bool drawn = is_drawn(scenario, observation.deployment, sampling.loss);
    result_.wanted = drawn ? sampling.samples : std::min<std::size_t>(sampling.samples, 1);
    runs_.resize(result_.wanted);
  }

  Predicted run() {
    checker::parallel_for(result_.wanted, sampling_.threads,
                          [this](std::size_t k) { return run_sample(k); });
    for (auto& run : runs_) {
      if (run) result_.runs.push_back(std::move(*run));
    }
    return std::move(result_);
  }

 private:
  bool run_sample(std::size_t k) {
    const std::uint64_t seed = sampling_.first_seed + k;
    const model::Scenario scenario = draw(scenario_, observation_.deployment, sampling_.loss, seed);
    MessageTally tally{scenario.dds.implementation, observation_.growth.step_ns,
                       most_growth * observed_steps};
    model::RunOptions options;
    options.probe = &tally;
    options.on_progress = [this](const model::Progress&) { return report(0); };
    const model::RunResult result = model::simulate(scenario, options);
    if (result.end == model::RunEnd::interrupted) return false;
    PredictedRun run;
    run.seed = seed;
    run.complete = result.completed();
    run.tally = tally.tally();
    run.tally[index_of(Figure::completion)] =
        static_cast<std::uint64_t>(result.discovery_time.value_or(scenario.time_limit).count());
    if (observation_.cut == Cut::last_initial && run.complete) run.tally = tally.at_last_initial();
    if (k == 0) result_.sizes = tally.sizes();
    run.growth = std::move(tally).finish();
    runs_[k] = std::move(run);
    return report(1);
  }

  bool report(std::size_t newly_finished) {
    const std::lock_guard lock{mutex_};
    finished_ += newly_finished;
    if (sampling_.on_progress && !sampling_.on_progress(finished_, result_.wanted)) stopped_ = true;
    return !stopped_;
  }

  const model::Scenario& scenario_;
  const Observation& observation_;
  const Sampling& sampling_;
  Predicted result_;
  std::vector<std::optional<PredictedRun>> runs_;
  std::mutex mutex_;
  std::size_t finished_ = 0;
  bool stopped_ = false;
};

}  // namespace

bool is_drawn(const model::Scenario& scenario, const CapturedDeployment& deployment, double loss) {
  if (loss > 0) return true;
  if (scenario.dds.implementation == model::ImplementationKind::paper) return false;
  return std::ranges::any_of(deployment.participants, [](const CapturedParticipant& one) {
    return one.done_earliest() < one.done_latest();
  });
}

model::Scenario draw(const model::Scenario& scenario, const CapturedDeployment& deployment,
                     double loss, std::uint64_t seed) {
  model::Scenario drawn = scenario;
  std::mt19937_64 random{seed};  // its sequence is fixed by the standard; distributions are not
  for (std::size_t k = 0; k < deployment.participants.size(); ++k) {
    const CapturedParticipant& one = deployment.participants[k];
    const auto values =
        static_cast<std::uint64_t>((one.done_latest() - one.done_earliest()).count()) + 1;
    drawn.deployment.participants[k].endpoints_done =
        one.done_earliest() + model::Nanoseconds{static_cast<std::int64_t>(random() % values)};
  }
  if (loss > 0) drawn.wireless.lost_packets = prediction::draw_losses(loss, seed);
  return drawn;
}

Predicted predict(const model::Scenario& scenario, const Observation& observation,
                  const Sampling& sampling) {
  return Pool{scenario, observation, sampling}.run();
}

}  // namespace stormproof::validate
