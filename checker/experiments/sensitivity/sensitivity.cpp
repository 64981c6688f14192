// All runs of one phase (single changes, then pairs) go to the threads as one list of jobs; the
// comparison comes when they are done.
#include "checker/experiments/sensitivity/sensitivity.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <mutex>
#include <random>

#include "checker/experiments/statistics/quantiles.hpp"
#include "checker/experiments/trials/parallel.hpp"
#include "model/simulator.hpp"

namespace stormproof::sensitivity {

namespace {

using model::Scenario;

struct Outcome {
  std::array<double, measures.size()> cost{};
  bool completed = false;
};

/// The outcomes of one scenario by sample; incomplete if the runs were stopped.
using Outcomes = std::vector<std::optional<Outcome>>;

bool all_there(const Outcomes& outcomes) {
  return std::ranges::all_of(outcomes, [](const auto& outcome) { return outcome.has_value(); });
}

std::size_t incomplete_runs(const Outcomes& outcomes) {
  return static_cast<std::size_t>(
      std::ranges::count_if(outcomes, [](const auto& outcome) { return !outcome->completed; }));
}

/// The start times of one sample.
Scenario sampled(Scenario scenario, std::uint64_t seed, model::Nanoseconds jitter) {
  model::Deployment& deployment = scenario.deployment;
  if (deployment.schedule) deployment.draw_schedule(seed);
  if (jitter.count() == 0) return scenario;
  std::mt19937_64 random{seed};
  const auto values = static_cast<std::uint64_t>(jitter.count()) + 1;
  for (model::Participant& participant : deployment.participants) {
    const model::Nanoseconds later{static_cast<std::int64_t>(random() % values)};
    participant.start = participant.start + later;
    participant.endpoints_done = participant.endpoints_done + later;
  }
  return scenario;
}

class Runner {
 public:
  explicit Runner(const Options& options) : options_{options} {}

  /// Runs every sample of every scenario.
  std::vector<Outcomes> run(const std::vector<const Scenario*>& scenarios) {
    std::vector<Outcomes> outcomes(scenarios.size(), Outcomes(options_.samples));
    planned_ += scenarios.size() * options_.samples;
    const std::size_t jobs = scenarios.size() * options_.samples;
    finished_all_ = checker::parallel_for(jobs, options_.threads,
                                          [&](std::size_t job) {
                                            // Sample by sample, so that a study that is stopped
                                            // knows something of every change.
                                            const std::size_t sample = job / scenarios.size();
                                            const std::size_t which = job % scenarios.size();
                                            outcomes[which][sample] = run_one(
                                                *scenarios[which], options_.first_seed + sample);
                                            return outcomes[which][sample] && report(1);
                                          }) &&
                    finished_all_;
    return outcomes;
  }

  [[nodiscard]] bool finished_all() const { return finished_all_; }
  [[nodiscard]] std::size_t runs() const { return runs_; }

 private:
  std::optional<Outcome> run_one(const Scenario& scenario, std::uint64_t seed) {
    const Scenario sample = sampled(scenario, seed, options_.start_jitter);
    model::RunOptions run_options;
    run_options.on_progress = [this](const model::Progress&) { return report(0); };
    const model::RunResult run = simulate(sample, run_options);
    if (run.end == model::RunEnd::interrupted) return std::nullopt;
    const model::Nanoseconds took = run.discovery_time.value_or(sample.time_limit);
    return Outcome{{static_cast<double>(took.count()), static_cast<double>(run.counts.total())},
                   run.completed()};
  }

  bool report(std::size_t newly_finished) {
    const std::lock_guard lock{mutex_};
    runs_ += newly_finished;
    if (options_.on_progress && !options_.on_progress(runs_, planned_)) stopped_ = true;
    return !stopped_;
  }

  const Options& options_;
  std::mutex mutex_;
  std::size_t planned_ = 0;
  std::size_t runs_ = 0;
  bool stopped_ = false;
  bool finished_all_ = true;
};

/// Effects of the sums, over samples, of outcomes with these signs.
Effects effects_of(const std::vector<std::pair<const Outcomes*, int>>& terms) {
  Effects effects;
  for (std::size_t m = 0; m < measures.size(); ++m) {
    std::vector<double> differences(terms.front().first->size());
    for (const auto& [outcomes, sign] : terms) {
      for (std::size_t k = 0; k < differences.size(); ++k) {
        differences[k] += sign * (*outcomes)[k]->cost[m];
      }
    }
    effects[m] = effect_of(std::move(differences));
  }
  return effects;
}

/// The unchanged scenario and all single changes, with what came out of them.
class Study {
 public:
  Study(const Scenario& scenario, const Options& options)
      : scenario_{scenario},
        options_{options},
        runner_{options},
        knobs_{knobs_of(scenario, options.range)} {}

  Report run() {
    run_single_changes();
    if (report_.finished && options_.pairs_of > 1) run_pairs();
    report_.runs = runner_.runs();
    report_.finished = runner_.finished_all();
    return std::move(report_);
  }

 private:
  void run_single_changes() {
    std::vector<const Scenario*> scenarios{&scenario_};
    for (const Knob& knob : knobs_) {
      for (const auto& level : knob.levels) {
        if (level) scenarios.push_back(&level->scenario);
      }
    }
    singles_ = runner_.run(scenarios);
    report_.finished = runner_.finished_all();
    keep_complete_samples();
    if (!all_there(singles_.front())) return;
    describe_base();
    std::size_t next = 1;
    for (const Knob& knob : knobs_) describe(knob, next);
    std::ranges::stable_sort(report_.knobs, std::greater<>{},
                             [this](const KnobResult& knob) { return knob.swing(options_.by); });
  }

  /// Of a study that was stopped, keeps the samples that every change has, and at least the first
  /// one; changes without it are then left out.
  void keep_complete_samples() {
    std::size_t complete = 0;
    while (complete < options_.samples && std::ranges::all_of(singles_, [&](const Outcomes& o) {
             return o[complete].has_value();
           })) {
      ++complete;
    }
    report_.samples = std::max<std::size_t>(complete, 1);
    for (Outcomes& outcomes : singles_) outcomes.resize(report_.samples);
  }

  void describe_base() {
    for (std::size_t m = 0; m < measures.size(); ++m) {
      std::vector<double> values;
      for (const auto& outcome : singles_.front()) values.push_back(outcome->cost[m]);
      report_.base[m] = *sampling::quantiles(std::move(values)).median;
    }
    report_.incomplete = incomplete_runs(singles_.front());
  }

  /// `next` is the number of the knob's first level in `singles_`, and then that of the next knob.
  void describe(const Knob& knob, std::size_t& next) {
    KnobResult result{knob.key, knob.value, knob.doc, {}, knob.obstacle};
    bool any = false;
    for (const Direction direction : directions) {
      const auto d = static_cast<std::size_t>(direction);
      if (!knob.levels[d]) continue;
      const Outcomes& outcomes = singles_[next++];
      if (!all_there(outcomes)) continue;
      result.levels[d] =
          LevelResult{knob.levels[d]->value, effects_of({{&outcomes, 1}, {&singles_.front(), -1}}),
                      incomplete_runs(outcomes)};
      single_of_[{knob.key, direction}] = &outcomes;
      any = true;
    }
    if (any) {
      report_.knobs.push_back(std::move(result));
    } else if (!knob.levels[0] && !knob.levels[1]) {
      report_.unvaried.push_back(std::move(result));
    }
  }

  [[nodiscard]] Direction greater_effect(const KnobResult& knob) const {
    const auto size = [&](std::size_t d) {
      return knob.levels[d] ? std::abs(of(knob.levels[d]->effects, options_.by).median) : -1;
    };
    return size(1) >= size(0) ? Direction::up : Direction::down;
  }

  void run_pairs() {
    std::vector<PairResult> pairs;
    std::vector<Scenario> changed;
    const std::size_t first = std::min(options_.pairs_of, report_.knobs.size());
    for (std::size_t a = 0; a < first; ++a) {
      for (std::size_t b = a + 1; b < first; ++b) {
        const KnobResult& one = report_.knobs[a];
        const KnobResult& other = report_.knobs[b];
        const std::array both{greater_effect(one), greater_effect(other)};
        const auto half = moved(scenario_, one.key, both[0], options_.range);
        auto whole = half ? moved(half->scenario, other.key, both[1], options_.range)
                          : std::optional<Level>{};
        if (!whole) continue;
        pairs.push_back({{one.key, other.key}, both, {}, {}});
        changed.push_back(std::move(whole->scenario));
      }
    }
    std::vector<const Scenario*> scenarios;
    for (const Scenario& scenario : changed) scenarios.push_back(&scenario);
    const std::vector<Outcomes> outcomes = runner_.run(scenarios);
    for (std::size_t k = 0; k < pairs.size(); ++k) {
      if (all_there(outcomes[k])) describe(pairs[k], outcomes[k]);
    }
    std::ranges::stable_sort(report_.pairs, std::greater<>{}, [this](const PairResult& pair) {
      return std::abs(of(pair.interaction, options_.by).median);
    });
  }

  void describe(PairResult pair, const Outcomes& both) {
    const Outcomes* base = &singles_.front();
    const Outcomes* one = single_of_.at({pair.keys[0], pair.directions[0]});
    const Outcomes* other = single_of_.at({pair.keys[1], pair.directions[1]});
    pair.joint = effects_of({{&both, 1}, {base, -1}});
    pair.interaction = effects_of({{&both, 1}, {one, -1}, {other, -1}, {base, 1}});
    report_.pairs.push_back(std::move(pair));
  }

  const Scenario& scenario_;
  const Options& options_;
  Runner runner_;
  const std::vector<Knob> knobs_;
  std::vector<Outcomes> singles_;  // the unchanged scenario, then each level of each knob
  std::map<std::pair<std::string, Direction>, const Outcomes*> single_of_;
  Report report_;
};

}  // namespace

const char* name_of(Measure measure) {
  return measure == Measure::completion ? "completion" : "messages";
}

double KnobResult::swing(Measure measure) const {
  double greatest = 0;
  for (const auto& level : levels) {
    if (level) greatest = std::max(greatest, std::abs(of(level->effects, measure).median));
  }
  return greatest;
}

bool KnobResult::is_without_effect(Measure measure) const {
  return std::ranges::all_of(levels, [measure](const auto& level) {
    return !level || of(level->effects, measure).exactly_zero;
  });
}

Report analyse(const Scenario& scenario, const Options& options) {
  return Study{scenario, options}.run();
}

}  // namespace stormproof::sensitivity
