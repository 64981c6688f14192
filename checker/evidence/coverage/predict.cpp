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

using Values = MeasureValues;

/// What a discovery took and sent; of one that is held its counts, too, if it is not complete.
void add_discovery(const std::optional<model::Nanoseconds>& time, const model::Counts& sent,
                   bool held, Values& values) {
  const auto put = [&](Measure measure, double value) {
    values[static_cast<std::size_t>(measure)] = value;
  };
  const bool counts = time || held;
  put(Measure::completion, time ? static_cast<double>(time->count()) / 1e6 : statistics::unreached);
  put(Measure::messages, counts ? static_cast<double>(sent.total()) : statistics::unreached);
  for (const model::MessageClass one : model::message_classes) {
    put(statistics::measure_of(one),
        counts ? static_cast<double>(sent[one]) : statistics::unreached);
  }
}

std::optional<Values> values_of_changed(trials::Runner& runner, const Case& one,
                                        const model::Scenario& scenario) {
  const auto run = run_changed(runner, one.change, scenario);
  if (!run) return std::nullopt;
  Values values;
  add_discovery(run->first_completion(one.change), run->sent_at_first(one.change), one.held,
                values);
  add_values(one.change, *run, values);
  return values;
}

std::optional<Values> values_of(trials::Runner& runner, const Case& one,
                                const model::Scenario& scenario) {
  if (one.change.happens()) return values_of_changed(runner, one, scenario);
  const auto run = runner.simulate(scenario);
  if (!run) return std::nullopt;
  Values values;
  add_discovery(run->discovery_time, run->counts, one.held, values);
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
    return values_of(runner, one, scenario);
  });
  Predictions predictions;
  predictions.finished = !runner.stopped();
  predictions.cases.resize(cases.size());
  for (std::size_t k = 0; k < jobs.size(); ++k) {
    if (!results[k]) continue;
    Prediction& prediction = predictions.cases[jobs[k].of_case];
    for (std::size_t m = 0; m < measure_count; ++m) {
      if ((*results[k])[m]) prediction.values[m].push_back(*(*results[k])[m]);
    }
    if (std::isinf(*(*results[k])[0])) ++prediction.incomplete;
    prediction.own = cases[jobs[k].of_case].starts.measured();
  }
  return predictions;
}

}  // namespace stormproof::prediction
