// Looks at growing samples: runs, judges, and runs more where something is open.
#include "checker/experiments/diff/costs.hpp"

#include <algorithm>

#include <fmt/format.h>

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
    for (std::size_t samples = first_; !open.empty() && !answer_.interrupted;
         samples = std::min(2 * samples, request_.most_samples)) {
      run_points(open, samples);
      open = judge_points(open);
      std::erase_if(open, [this](std::size_t point) { return !points_[point].is_drawn(); });
      if (samples >= request_.most_samples) break;
    }
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
    RunSettings settings;
    settings.first_seed = request_.first_seed;
    settings.threads = request_.threads;
    settings.on_progress = [this](std::size_t finished, std::size_t all) {
      return !request_.on_progress ||
             request_.on_progress(fmt::format("costs: {} of {} pairs of runs", finished, all));
    };
    answer_.interrupted = !add_runs(points_, wanted, settings, answer_.runs);
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
  const std::size_t first_;  ///< samples of the first look
  CostAnswer answer_;
  std::vector<Configuration> judged_;
  std::vector<bool> is_judged_;
};

}  // namespace

CostAnswer compare_costs(const CostRequest& request) { return CostStudy{request}.run(); }

}  // namespace stormproof::diff
