// Looks at growing samples: runs, judges, and runs more where something is open.
#include "checker/experiments/diff/costs.hpp"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "checker/experiments/diff/words.hpp"
#include "checker/experiments/trials/patience.hpp"

namespace stormproof::diff {

namespace {

/// How often samples can double from `first` until they are `most`, and the first look.
std::size_t count_looks(std::size_t first, std::size_t most) {
  std::size_t looks = 1;
  for (std::size_t samples = first; samples < most; samples *= 2) ++looks;
  return looks;
}

/// A first look at fewer pairs than can reach the confidence would say nothing.
std::size_t first_look(const CostRequest& request, double confidence) {
  return std::clamp(statistics::fewest_pairs(confidence), request.samples,
                    std::max(request.samples, request.most_samples));
}

class CostStudy {
 public:
  explicit CostStudy(const CostRequest& request)
      : request_{request},
        points_{request.grid.points},
        judge_{request.policy, points_, count_looks(request.samples, request.most_samples)},
        first_{first_look(request, judge_.single_confidence())},
        most_{request.most_samples},
        judged_(points_.size()),
        is_judged_(points_.size(), false) {
    answer_.runs.resize(points_.size());
    answer_.comparison.grid = request.grid.name;
    answer_.comparison.samples = first_;
    answer_.comparison.seed = request.first_seed;
    answer_.comparison.wanted = points_.size();
    answer_.comparison.confidence = judge_.single_confidence();
  }

  CostAnswer run() {
    std::vector<std::size_t> open(points_.size());
    for (std::size_t k = 0; k < open.size(); ++k) open[k] = k;
    if (request_.time.is_limited()) fit_into_time(open);
    for (std::size_t samples = first_; !open.empty() && !answer_.interrupted;
         samples = std::min(2 * samples, most_)) {
      run_points(open, samples);
      open = judge_points(open);
      std::erase_if(open, [this](std::size_t point) { return !points_[point].is_drawn(); });
      if (samples >= most_) break;
      if (open.size() * samples > pace_.fitting(request_.time, request_.runner.finished())) {
        note_unclear(open, samples);
        break;
      }
    }
    note_cut();
    for (std::size_t k = 0; k < points_.size(); ++k) {
      if (is_judged_[k]) answer_.comparison.configurations.push_back(std::move(judged_[k]));
    }
    return std::move(answer_);
  }

 private:
  void run_points(const std::vector<std::size_t>& open, std::size_t samples) {
    std::vector<RunsWanted> wanted;
    for (const std::size_t point : open) {
      wanted.push_back({point, points_[point].is_drawn() ? samples : 1});
    }
    answer_.interrupted =
        !add_runs(points_, wanted, request_.first_seed, request_.runner, answer_.runs);
  }

  /// One pair of each deployment says how many there is time for. If that is not enough, the side
  /// that takes longer is cut; what is still too much is not run. Limits are about whole runs:
  /// those are not cut.
  void fit_into_time(const std::vector<std::size_t>& open) {
    run_points(open, 1);
    if (answer_.interrupted) return;
    std::size_t wanted = 0;
    for (const ReviewedPoint& point : points_) wanted += point.is_drawn() ? first_ - 1 : 0;
    const std::size_t fits = pace_.fitting(request_.time, request_.runner.finished());
    if (wanted <= fits) return;
    double cost = 1;  // of a pair, beside one that is not cut
    if (!request_.policy.limits) {
      cost = 0;
      for (std::size_t k = 0; k < points_.size(); ++k) cost = std::max(cost, cut(k));
    }
    const std::size_t drawn = wanted / (first_ - 1);
    const auto most = static_cast<std::size_t>(static_cast<double>(fits) / cost) / drawn;
    const std::size_t samples = std::clamp<std::size_t>(1 + most, 1, first_);
    answer_.unasked.note("pairs of runs of each configuration", samples, first_);
    first_ = samples;
    most_ = samples;
  }

  /// Cuts the runs of a deployment from now on, where one side takes several times as long as the
  /// other; returns about which part of their time remains. Where neither completes, cut runs would
  /// say nothing.
  double cut(std::size_t k) {
    const ReviewedPoint& point = points_[k];
    PairedRuns& runs = answer_.runs[k];
    const auto completion = static_cast<std::size_t>(Measure::completion);
    const double before = runs.before.front()[completion];
    const double after = runs.after.front()[completion];
    trials::Patience patience{point.base.time_limit, exact::late_limit(point.limits)};
    patience.see(std::min(before, after), trials::beside_best);
    const auto at = static_cast<double>(patience.limit().count());
    if (point.limits || !point.is_drawn() || std::max(before, after) <= at) return 1;
    const auto whole = static_cast<double>(point.base.time_limit.count());
    if (at >= whole) return 1;
    runs = {};  // the first pair again, as all others
    runs.cut_at = patience.limit();
    return (std::min(before, after) + at) /
           (std::min(before, after) + std::min(whole, std::max(before, after)));
  }

  void note_unclear(const std::vector<std::size_t>& open, std::size_t samples) {
    answer_.unasked.note(
        fmt::format("pairs of runs of {} that {} unclear", plural(open.size(), "configuration"),
                    open.size() == 1 ? "is" : "are"),
        samples, request_.most_samples);
  }

  void note_cut() {
    for (const PairedRuns& runs : answer_.runs) {
      const auto cut = [&runs](const RunValues& run) { return runs.is_cut(run); };
      const auto count =
          std::ranges::count_if(runs.before, cut) + std::ranges::count_if(runs.after, cut);
      if (count == 0) continue;
      answer_.unasked.cuts.push_back({"runs", static_cast<std::size_t>(count), *runs.cut_at});
    }
  }

  /// Those that stay unclear.
  std::vector<std::size_t> judge_points(const std::vector<std::size_t>& open) {
    std::vector<std::size_t> places;
    std::vector<Configuration> configurations;
    std::vector<const PairedRuns*> runs;
    for (const std::size_t point : open) {
      if (answer_.runs[point].size() == 0) continue;
      places.push_back(point);
      if (places.size() == 1) {
        answer_.comparison.storm = exact::storm_definition(points_[point].limits);
      }
      configurations.push_back(judge_.judge(points_[point], answer_.runs[point]));
      runs.push_back(&answer_.runs[point]);
    }
    std::vector<PooledChange>& pooled = answer_.comparison.pooled;
    std::erase_if(pooled, [](const PooledChange& change) {  // they are open again
      return change.judgment == Judgment::unclear;
    });
    for (const PooledChange& change : judge_.settle(configurations, runs)) pooled.push_back(change);
    std::vector<std::size_t> unclear;
    for (std::size_t k = 0; k < places.size(); ++k) {
      if (is_unclear(configurations[k])) unclear.push_back(places[k]);
      judged_[places[k]] = std::move(configurations[k]);
      is_judged_[places[k]] = true;
    }
    return unclear;
  }

  const CostRequest& request_;
  const std::vector<ReviewedPoint>& points_;
  CostJudge judge_;
  trials::Pace pace_{request_.time, request_.runner.finished()};
  std::size_t first_;  ///< samples of the first look
  std::size_t most_;   ///< of the last one
  CostAnswer answer_;
  std::vector<Configuration> judged_;
  std::vector<bool> is_judged_;
};

}  // namespace

CostAnswer compare_costs(const CostRequest& request) { return CostStudy{request}.run(); }

}  // namespace stormproof::diff
