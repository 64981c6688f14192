// Runs go to the threads as one list of jobs; results are kept by setting and seed, so they do not
// depend on which thread was faster.
#include "checker/experiments/tune/outcome.hpp"

#include <algorithm>
#include <cmath>
#include <set>

#include "checker/experiments/statistics/quantiles.hpp"

namespace stormproof::tune {

Cost cost_of(std::span<const Outcome> outcomes) {
  if (outcomes.empty()) return {};
  std::vector<double> completion;
  std::vector<double> messages;
  std::vector<double> missing;
  for (const Outcome& outcome : outcomes) {
    completion.push_back(statistics::completion_ns(outcome.completion));
    messages.push_back(static_cast<double>(outcome.counts.total()));
    missing.push_back(outcome.missing);
  }
  Cost cost{statistics::median(std::move(completion)), statistics::median(std::move(messages))};
  if (std::isinf(cost.completion)) cost.missing = statistics::median(std::move(missing));
  return cost;
}

std::vector<std::string_view> broken_in(std::span<const Outcome> outcomes) {
  std::set<std::string_view> ids;
  for (const Outcome& outcome : outcomes) ids.insert(outcome.broken.begin(), outcome.broken.end());
  return {ids.begin(), ids.end()};
}

Archive::Archive(const Problem& problem, model::Nanoseconds limit, trials::Runner& runner)
    : problem_{problem}, limit_{limit}, runner_{runner} {}

bool Archive::extend(const std::vector<Point>& points, Seeds seeds) {
  struct Job {
    const Point* point;
    std::uint64_t seed;
  };
  std::vector<Job> jobs;
  std::set<Point> distinct;
  for (const Point& point : points) {
    if (!distinct.insert(point).second) continue;
    const std::map<std::uint64_t, Outcome>& known = outcomes_[point];
    for (std::size_t k = 0; k < seeds.count; ++k) {
      if (!known.contains(seeds.first + k)) jobs.push_back({&point, seeds.first + k});
    }
  }
  if (!runner_.goes_on()) return false;
  auto results = runner_.run(jobs.size(), [&](std::size_t k) {
    return problem_.run(*jobs[k].point, jobs[k].seed, limit_);
  });
  for (std::size_t k = 0; k < jobs.size(); ++k) {
    if (!results[k]) continue;
    outcomes_[*jobs[k].point].emplace(jobs[k].seed, *std::move(results[k]));
    ++runs_;
  }
  return !runner_.stopped();
}

bool Archive::watch(const std::vector<Point>& points, Seeds seeds) {
  if (!problem_.watch) return true;
  struct Job {
    const Point* point;
    std::uint64_t seed;
    Outcome* outcome;
  };
  std::vector<Job> jobs;
  const std::set<Point> distinct{points.begin(), points.end()};
  for (const Point& point : distinct) {
    for (auto& [seed, outcome] : outcomes_[point]) {
      const bool asked = seed >= seeds.first && seed - seeds.first < seeds.count;
      if (asked && !outcome.watched) jobs.push_back({&point, seed, &outcome});
    }
  }
  if (!runner_.goes_on()) return false;
  const auto results = runner_.run(jobs.size(), [&](std::size_t k) {
    return problem_.watch(*jobs[k].point, jobs[k].seed, limit_);
  });
  for (std::size_t k = 0; k < jobs.size(); ++k) {
    if (!results[k]) continue;
    std::vector<std::string_view>& broken = jobs[k].outcome->broken;
    broken.insert(broken.end(), results[k]->begin(), results[k]->end());
    std::ranges::sort(broken);
    jobs[k].outcome->watched = true;
  }
  return !runner_.stopped();
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
  return cost_of(outcomes(point, seeds));
}

bool Archive::keeps(const Point& point, Seeds seeds) const {
  return broken_in(outcomes(point, seeds)).empty();
}

}  // namespace stormproof::tune
