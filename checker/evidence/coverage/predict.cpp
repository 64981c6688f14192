// One job for each run, the large configurations first.
#include "checker/evidence/coverage/predict.hpp"

#include <cmath>

#include "checker/experiments/statistics/completion.hpp"
#include "checker/experiments/trials/losses.hpp"
#include "checker/experiments/trials/under_seed.hpp"

namespace stormproof::prediction {

namespace {

/// One run of one case.
struct Job {
  std::size_t of_case = 0;
  std::size_t sample = 0;
};

using Values = std::array<double, measure_count>;

Values values_of(const model::RunResult& run, bool held) {
  Values values;
  values.fill(statistics::unreached);
  if (!run.completed() && !held) return values;
  const auto put = [&values](Measure measure, double value) {
    values[static_cast<std::size_t>(measure)] = value;
  };
  if (run.completed()) {
    put(Measure::completion, static_cast<double>(run.discovery_time->count()) / 1e6);
  }
  put(Measure::messages, static_cast<double>(run.counts.total()));
  for (const model::MessageClass one : model::message_classes) {
    put(statistics::measure_of(one), static_cast<double>(run.counts[one]));
  }
  return values;
}

/// One entry for each run, the large configurations first.
std::vector<Job> jobs_of(std::span<const Case> cases, const PredictOptions& options) {
  std::vector<Job> jobs;
  for (std::size_t k = cases.size(); k-- > 0;) {
    const std::size_t samples = cases[k].sampled() ? options.samples : 1;
    for (std::size_t s = 0; s < samples; ++s) jobs.push_back({k, s});
  }
  return jobs;
}

}  // namespace

Predictions predict(std::span<const Case> cases, const PredictOptions& options) {
  const std::vector<Job> jobs = jobs_of(cases, options);
  trials::Runner runner{options.threads, options.on_progress};
  const auto results = runner.run(jobs.size(), [&](std::size_t k) -> std::optional<Values> {
    const Case& one = cases[jobs[k].of_case];
    const std::uint64_t seed = options.first_seed + jobs[k].sample;
    model::Scenario scenario = trials::under_seed(one.scenario, seed);
    one.starts.put(scenario.deployment, jobs[k].sample, seed);
    if (one.loss > 0) scenario.wireless.lost_packets = trials::draw_losses(one.loss, seed);
    const auto run = runner.simulate(scenario);
    if (!run) return std::nullopt;
    return values_of(*run, one.held);
  });
  Predictions predictions;
  predictions.finished = !runner.stopped();
  predictions.cases.resize(cases.size());
  for (std::size_t k = 0; k < jobs.size(); ++k) {
    if (!results[k]) continue;
    Prediction& prediction = predictions.cases[jobs[k].of_case];
    for (std::size_t m = 0; m < measure_count; ++m) {
      prediction.values[m].push_back((*results[k])[m]);
    }
    if (std::isinf((*results[k])[0])) ++prediction.incomplete;
  }
  return predictions;
}

}  // namespace stormproof::prediction
