// One job for each run, the large configurations first.
#include "checker/evidence/coverage/predict.hpp"

#include <cmath>
#include <limits>
#include <mutex>
#include <random>

#include "checker/experiments/trials/parallel.hpp"
#include "model/simulator.hpp"

namespace stormproof::prediction {

namespace {

/// One run of one case.
struct Job {
  std::size_t of_case = 0;
  std::uint64_t seed = 0;
};

std::array<double, measure_count> values_of(const model::RunResult& run) {
  std::array<double, measure_count> values;
  values.fill(std::numeric_limits<double>::infinity());
  if (!run.completed()) return values;
  const auto put = [&values](Measure measure, double value) {
    values[static_cast<std::size_t>(measure)] = value;
  };
  const auto count = [&put](Measure measure, std::uint64_t messages) {
    put(measure, static_cast<double>(messages));
  };
  put(Measure::completion, static_cast<double>(run.discovery_time->count()) / 1e6);
  count(Measure::total, run.counts.total());
  count(Measure::spdp_multicast, run.counts.spdp_multicast);
  count(Measure::spdp_unicast, run.counts.spdp_unicast);
  count(Measure::initial_data, run.counts.initial_data);
  count(Measure::repair_data, run.counts.repair_data);
  count(Measure::heartbeat, run.counts.heartbeat);
  count(Measure::acknack, run.counts.acknack);
  return values;
}

class Pool {
 public:
  Pool(std::span<const Case> cases, const PredictOptions& options)
      : cases_{cases}, options_{options} {
    for (std::size_t k = cases.size(); k-- > 0;) {
      const std::size_t samples = cases[k].sampled() ? options.samples : 1;
      for (std::size_t s = 0; s < samples; ++s) jobs_.push_back({k, options.first_seed + s});
    }
    results_.resize(jobs_.size());
  }

  Predictions run() {
    Predictions predictions;
    predictions.finished = checker::parallel_for(jobs_.size(), options_.threads,
                                                 [this](std::size_t k) { return run_job(k); });
    predictions.cases.resize(cases_.size());
    for (std::size_t k = 0; k < jobs_.size(); ++k) {
      if (!results_[k]) continue;
      Prediction& prediction = predictions.cases[jobs_[k].of_case];
      for (std::size_t m = 0; m < measure_count; ++m) {
        prediction.values[m].push_back((*results_[k])[m]);
      }
      if (std::isinf((*results_[k])[0])) ++prediction.incomplete;
    }
    return predictions;
  }

 private:
  bool run_job(std::size_t k) {
    const Case& chosen = cases_[jobs_[k].of_case];
    model::Scenario scenario = chosen.scenario;
    if (scenario.deployment.schedule) scenario.deployment.draw_schedule(jobs_[k].seed);
    if (chosen.loss > 0) {
      scenario.wireless.lost_packets = draw_losses(chosen.loss, jobs_[k].seed);
    }
    model::RunOptions run_options;
    run_options.on_progress = [this](const model::Progress&) { return report(0); };
    const model::RunResult run = model::simulate(scenario, run_options);
    if (run.end == model::RunEnd::interrupted) return false;
    results_[k] = values_of(run);
    return report(1);
  }

  bool report(std::size_t newly_finished) {
    const std::lock_guard lock{mutex_};
    finished_ += newly_finished;
    if (options_.on_progress && !options_.on_progress(finished_, jobs_.size())) stopped_ = true;
    return !stopped_;
  }

  std::span<const Case> cases_;
  const PredictOptions& options_;
  std::vector<Job> jobs_;
  std::vector<std::optional<std::array<double, measure_count>>> results_;
  bool stopped_ = false;
  std::mutex mutex_;
  std::size_t finished_ = 0;
};

}  // namespace

Predictions predict(std::span<const Case> cases, const PredictOptions& options) {
  return Pool{cases, options}.run();
}

std::vector<std::uint64_t> draw_losses(double probability, std::uint64_t seed) {
  constexpr std::uint64_t packets = 2'000'000;
  constexpr std::uint64_t other_than_schedules = 0x6c6f7373;  // the schedule has the plain seed
  std::mt19937_64 random{seed ^ other_than_schedules};
  std::vector<std::uint64_t> lost;
  const double scale = std::ldexp(1.0, -64);
  for (std::uint64_t packet = 0; packet < packets; ++packet) {
    if (static_cast<double>(random()) * scale < probability) lost.push_back(packet);
  }
  return lost;
}

}  // namespace stormproof::prediction
