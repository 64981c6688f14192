// All runs of one phase (single changes, then pairs) go to the threads as one list of jobs; the
// comparison comes when they are done.
#include "checker/experiments/sensitivity/sensitivity.hpp"

#include <algorithm>
#include <atomic>
#include <cmath>
#include <map>

#include "checker/engines/exact/storm.hpp"
#include "checker/experiments/statistics/completion.hpp"
#include "checker/experiments/statistics/quantiles.hpp"
#include "checker/experiments/trials/under_seed.hpp"

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
    statistics::PairedDifferences pairs;
    for (const double difference : differences) pairs.add(difference);
    const statistics::Shift shift = pairs.shift();
    effects[m] = {shift.estimate, shift.low, shift.high, shift.confidence, pairs.all_zero()};
  }
  return effects;
}

/// The unchanged scenario and all single changes, with what came out of them.
class Study {
 public:
  Study(const Scenario& scenario, const Options& options)
      : scenario_{scenario},
        options_{options},
        samples_{options.samples},
        pairs_of_{options.pairs_of},
        runner_{options.threads, options.on_progress},
        knobs_{knobs_of(scenario, options.range)} {}

  Report run() {
    fit_into_time();
    run_single_changes();
    if (report_.finished && pairs_of_ > 1) run_pairs();
    report_.runs = runner_.finished();
    report_.finished = !runner_.stopped();
    if (cut_ > 0) report_.unasked.cuts.push_back({"runs", cut_, *report_.cut_at});
    return std::move(report_);
  }

 private:
  /// Fewer pairs say nothing with confidence.
  static constexpr std::size_t least_samples = 6;

  /// If there is no time for all: no pairs, then fewer samples, and where the unchanged scenario
  /// does not complete, shorter runs of all.
  void fit_into_time() {
    if (!options_.time.is_limited()) return;
    const trials::Pace pace{options_.time, 0};
    std::atomic<bool> completes = false;
    runner_.each(std::min<std::size_t>(2, samples_), [&](std::size_t k) {
      const auto run = run_one(unchanged_, options_.first_seed + k);
      if (run && run->completed) completes = true;
      return run.has_value();
    });
    const std::size_t fits = pace.fitting(options_.time, runner_.finished());
    std::size_t changes = 1;
    for (const Knob& knob : knobs_) {
      for (const auto& level : knob.levels) changes += level ? 1U : 0U;
    }
    const std::size_t pairs = pairs_of_ < 2 ? 0 : pairs_of_ * (pairs_of_ - 1) / 2;
    if ((changes + pairs) * samples_ <= fits) return;
    if (pairs > 0) report_.unasked.left_out.emplace_back("pairs");
    pairs_of_ = 0;
    samples_ = std::clamp(fits / changes, std::min(least_samples, samples_), samples_);
    report_.unasked.note("runs of each change", samples_, options_.samples);
    const std::size_t all = changes * samples_;
    if (all <= fits || completes) return;
    const double part = static_cast<double>(fits) / static_cast<double>(all);
    const double limit = static_cast<double>(scenario_.time_limit.count());
    const model::Nanoseconds cut{std::llround(part * limit)};
    report_.cut_at =
        std::min(scenario_.time_limit, std::max(cut, exact::late_limit(scenario_.limits)));
  }

  /// Every sample of every scenario; sample by sample, so that a study that is stopped knows
  /// something of every change.
  std::vector<Outcomes> run_all(const std::vector<const Level*>& levels) {
    const std::size_t count = levels.size();
    auto by_job = runner_.run(count * samples_, [&](std::size_t job) {
      return run_one(*levels[job % count], options_.first_seed + job / count);
    });
    std::vector<Outcomes> outcomes(count);
    for (std::size_t job = 0; job < by_job.size(); ++job) {
      outcomes[job % count].push_back(by_job[job]);
    }
    return outcomes;
  }

  std::optional<Outcome> run_one(const Level& level, std::uint64_t seed) {
    Scenario drawn = trials::under_seed(level.scenario, seed, options_.start_jitter);
    if (level.plan) launch::follow(*level.plan, level.scenario.deployment, drawn);
    if (report_.cut_at) drawn.time_limit = std::min(drawn.time_limit, *report_.cut_at);
    const auto run = runner_.simulate(drawn);
    if (!run) return std::nullopt;
    if (report_.cut_at && !run->completed()) ++cut_;
    return Outcome{
        {statistics::completion_ns(run->discovery_time), static_cast<double>(run->counts.total())},
        run->completed()};
  }

  void run_single_changes() {
    std::vector<const Level*> levels{&unchanged_};
    for (const Knob& knob : knobs_) {
      for (const auto& level : knob.levels) {
        if (level) levels.push_back(&*level);
      }
    }
    singles_ = run_all(levels);
    report_.finished = !runner_.stopped();
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
    while (complete < samples_ && std::ranges::all_of(singles_, [&](const Outcomes& o) {
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
      report_.base[m] = statistics::median(std::move(values));
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
    std::vector<Level> changed;
    const std::size_t first = std::min(pairs_of_, report_.knobs.size());
    for (std::size_t a = 0; a < first; ++a) {
      for (std::size_t b = a + 1; b < first; ++b) {
        const KnobResult& one = report_.knobs[a];
        const KnobResult& other = report_.knobs[b];
        const std::array both{greater_effect(one), greater_effect(other)};
        const auto half = moved(scenario_, one.key, both[0], options_.range);
        auto whole = half ? moved(half->scenario, other.key, both[1], options_.range)
                          : std::optional<Level>{};
        if (!whole) continue;
        if (!whole->plan) whole->plan = half->plan;
        pairs.push_back({{one.key, other.key}, both, {}, {}});
        changed.push_back(*std::move(whole));
      }
    }
    std::vector<const Level*> levels;
    for (const Level& level : changed) levels.push_back(&level);
    const std::vector<Outcomes> outcomes = run_all(levels);
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
  const Level unchanged_{"", scenario_, {}};
  const Options& options_;
  std::size_t samples_, pairs_of_;
  std::atomic<std::size_t> cut_ = 0;
  trials::Runner runner_;
  const std::vector<Knob> knobs_;
  std::vector<Outcomes> singles_;  // the unchanged scenario, then each level of each knob
  std::map<std::pair<std::string, Direction>, const Outcomes*> single_of_;
  Report report_;
};

}  // namespace

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
