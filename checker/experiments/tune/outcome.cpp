// Runs go to the threads as one list of jobs; results are kept by setting and seed, so they do not
// depend on which thread was faster.
#include "checker/experiments/tune/outcome.hpp"

#include <algorithm>
#include <mutex>
#include <set>

#include "checker/experiments/statistics/quantiles.hpp"
#include "checker/experiments/trials/parallel.hpp"

namespace stormproof::tune {

namespace {

double median(std::vector<double> values) {
  return sampling::quantiles(std::move(values)).median.value_or(0);
}

}  // namespace

Cost cost_of(std::span<const Outcome> outcomes, model::Nanoseconds limit) {
  std::vector<double> completion;
  std::vector<double> messages;
  for (const Outcome& outcome : outcomes) {
    const double late = static_cast<double>(limit.count()) * (1 + outcome.missing);
    completion.push_back(outcome.completion ? static_cast<double>(outcome.completion->count())
                                            : late);
    messages.push_back(static_cast<double>(outcome.counts.total()));
  }
  return {median(std::move(completion)), median(std::move(messages))};
}

std::vector<std::string_view> broken_in(std::span<const Outcome> outcomes) {
  std::set<std::string_view> ids;
  for (const Outcome& outcome : outcomes) ids.insert(outcome.broken.begin(), outcome.broken.end());
  return {ids.begin(), ids.end()};
}

Archive::Archive(const Problem& problem, model::Nanoseconds limit, std::size_t threads,
                 Progress progress)
    : problem_{problem}, limit_{limit}, threads_{threads}, progress_{std::move(progress)} {}

bool Archive::extend(const std::vector<Point>& points, Seeds seeds) {
  struct Job {
    const Point* point;
    std::uint64_t seed;
    std::optional<Outcome> outcome;
  };
  std::vector<Job> jobs;
  std::set<Point> distinct;
  for (const Point& point : points) {
    if (!distinct.insert(point).second) continue;
    const std::map<std::uint64_t, Outcome>& known = outcomes_[point];
    for (std::size_t k = 0; k < seeds.count; ++k) {
      if (!known.contains(seeds.first + k)) jobs.push_back({&point, seeds.first + k, {}});
    }
  }
  std::mutex mutex;
  bool stopped = progress_ && !progress_(finished_);
  const bool all = !stopped && checker::parallel_for(jobs.size(), threads_, [&](std::size_t k) {
    jobs[k].outcome = problem_.run(*jobs[k].point, jobs[k].seed, limit_);
    const std::lock_guard lock{mutex};
    if (!jobs[k].outcome) return false;
    ++finished_;
    if (progress_ && !progress_(finished_)) stopped = true;
    return !stopped;
  });
  for (Job& job : jobs) {
    if (job.outcome) outcomes_[*job.point].emplace(job.seed, *std::move(job.outcome));
  }
  return all;
}

std::vector<Outcome> Archive::outcomes(const Point& point, Seeds seeds) const {
  std::vector<Outcome> found;
  const auto runs = outcomes_.find(point);
  if (runs == outcomes_.end()) return found;
  const auto end = runs->second.lower_bound(seeds.first + seeds.count);
  for (auto run = runs->second.lower_bound(seeds.first); run != end; ++run) {
    found.push_back(run->second);
  }
  return found;
}

std::size_t Archive::settings() const {
  return static_cast<std::size_t>(
      std::ranges::count_if(outcomes_, [](const auto& entry) { return !entry.second.empty(); }));
}

Cost Archive::cost(const Point& point, Seeds seeds) const {
  return cost_of(outcomes(point, seeds), limit_);
}

bool Archive::keeps(const Point& point, Seeds seeds) const {
  return broken_in(outcomes(point, seeds)).empty();
}

}  // namespace stormproof::tune
