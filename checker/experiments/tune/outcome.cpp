// Runs go to the threads as one list of jobs; results are kept by setting and seed, so they do not
// depend on which thread was faster.
#include "checker/experiments/tune/outcome.hpp"

#include <algorithm>
#include <cmath>
#include <set>

#include "checker/experiments/statistics/quantiles.hpp"

namespace stormproof::tune {

namespace {

/// Settings whose runs are made at once where they may be cut.
constexpr std::size_t portion = 16;

}  // namespace

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

Archive::Archive(const Problem& problem, trials::Patience patience, trials::Runner& runner)
    : problem_{problem}, patience_{patience}, runner_{runner} {}

bool Archive::extend(const std::vector<Point>& points, Seeds seeds) {
  std::vector<const Point*> distinct;
  std::set<Point> seen;
  for (const Point& point : points) {
    if (seen.insert(point).second) distinct.push_back(&point);
  }
  if (!runner_.goes_on()) return false;
  // Each portion has settings from everywhere in the list.
  const std::size_t portions = patience_.may_cut() ? (distinct.size() + portion - 1) / portion : 1;
  for (std::size_t first = 0; first < portions && !runner_.stopped(); ++first) {
    std::vector<Job> jobs;
    std::vector<const Point*> here;
    for (std::size_t k = first; k < distinct.size(); k += portions) {
      here.push_back(distinct[k]);
      const std::map<std::uint64_t, Outcome>& known = outcomes_[*distinct[k]];
      for (std::size_t s = 0; s < seeds.count; ++s) {
        if (!known.contains(seeds.first + s)) jobs.push_back({distinct[k], seeds.first + s});
      }
    }
    run(jobs);
    if (!patience_.may_cut() || runner_.stopped()) continue;
    for (const Point* point : here) {
      const std::vector<Outcome> all = outcomes(*point, seeds);
      if (broken_in(all).empty()) patience_.see(cost_of(all).completion, trials::beside_best);
    }
  }
  return !runner_.stopped();
}

void Archive::run(std::span<const Job> jobs) {
  const model::Nanoseconds limit = patience_.limit();
  auto results = runner_.run(jobs.size(), [&](std::size_t k) {
    return problem_.run(*jobs[k].point, jobs[k].seed, limit);
  });
  for (std::size_t k = 0; k < jobs.size(); ++k) {
    if (!results[k]) continue;
    results[k]->cut.reset();  // what takes as long as the limit of all is not cut
    if (!results[k]->completion && limit < patience_.whole()) results[k]->cut = limit;
    if (results[k]->cut) ++cuts_;
    outcomes_[*jobs[k].point].emplace(jobs[k].seed, *std::move(results[k]));
    ++runs_;
  }
}

bool Archive::watch(const std::vector<Point>& points, Seeds seeds) {
  if (!problem_.watch) return true;
  const model::Nanoseconds limit = patience_.limit();
  struct Watched {
    const Point* point;
    std::uint64_t seed;
    Outcome* outcome;
  };
  std::vector<Watched> jobs;
  const std::set<Point> distinct{points.begin(), points.end()};
  for (const Point& point : distinct) {
    for (auto& [seed, outcome] : outcomes_[point]) {
      const bool asked = seed >= seeds.first && seed - seeds.first < seeds.count;
      if (asked && !outcome.watched) jobs.push_back({&point, seed, &outcome});
    }
  }
  if (!runner_.goes_on()) return false;
  const auto results = runner_.run(jobs.size(), [&](std::size_t k) {
    return problem_.watch(*jobs[k].point, jobs[k].seed, limit);
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

void Archive::begin_anew(trials::Patience patience) {
  patience_ = patience;
  outcomes_.clear();
  runs_ = cuts_ = 0;
}

bool Archive::lengthen() {
  if (!patience_.lengthen()) return false;
  for (auto& [point, runs] : outcomes_) {
    cuts_ -= std::erase_if(runs, [](const auto& run) { return run.second.cut.has_value(); });
  }
  return true;
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
