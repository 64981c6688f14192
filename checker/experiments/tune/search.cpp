// Generations of settings, each a race; the winners of all races are the population from which the
// next generation is bred.
#include "checker/experiments/tune/search.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <optional>
#include <random>
#include <set>

namespace stormproof::tune {

namespace {

constexpr std::size_t children = 16;     ///< of each generation but the first
constexpr std::size_t parents = 12;      ///< settings that children are bred from
constexpr double first_share = 1.0 / 3;  ///< of the budget, for the first generation
constexpr std::size_t most_attempts = 50;

/// The same numbers on every machine, which the standard's distributions do not promise.
class Random {
 public:
  explicit Random(std::uint64_t seed) : engine_{seed} {}
  /// From 0 to 1.
  double unit() { return static_cast<double>(engine_() >> 11U) * 0x1p-53; }
  std::size_t below(std::size_t count) {
    return std::min(count - 1, static_cast<std::size_t>(unit() * static_cast<double>(count)));
  }
  /// From -1 to 1, small steps more often than large ones.
  double step() { return unit() + unit() - 1; }

 private:
  std::mt19937_64 engine_;
};

class Search {
 public:
  Search(const Problem& problem, Archive& archive, const SearchOptions& options)
      : problem_{problem}, archive_{archive}, options_{options}, random_{options.random} {
    for (const std::size_t part : {4U, 2U, 1U}) {
      const std::size_t runs = std::max<std::size_t>(options.seeds.count / part, 1);
      if (levels_.empty() || levels_.back() < runs) levels_.push_back(runs);
    }
  }

  SearchResult run() {
    const Point unchanged = problem_.space.unchanged();
    seen_.insert(unchanged);
    bool goes_on = archive_.extend({unchanged}, options_.seeds);
    if (goes_on) enter(unchanged);
    if (goes_on) goes_on = race(first_generation());
    while (goes_on && used() < 1) {
      const std::vector<Point> next = bred();
      if (next.empty()) break;  // the space is exhausted
      goes_on = race(next);
    }
    result_.finished = goes_on;
    result_.finished = conclude() && goes_on;
    return std::move(result_);
  }

 private:
  [[nodiscard]] double used() const {
    const double runs = static_cast<double>(archive_.runs()) / static_cast<double>(options_.budget);
    return options_.time_used ? std::max(runs, options_.time_used()) : runs;
  }

  [[nodiscard]] Seeds seeds(std::size_t count) const { return {options_.seeds.first, count}; }

  /// Runs that a race costs for each of its settings.
  [[nodiscard]] double race_cost() const {
    double cost = 0;
    double share = 1;
    std::size_t before = 0;
    for (const std::size_t level : levels_) {
      cost += share * static_cast<double>(level - before);
      before = level;
      share /= 2;
    }
    return cost;
  }

  bool is_new(const Point& point) {
    return !seen_.contains(point) && (!problem_.is_valid || problem_.is_valid(point));
  }

  void add_new(const Point& point, std::vector<Point>& points) {
    if (!is_new(point)) return;
    seen_.insert(point);
    points.push_back(point);
  }

  /// Half of the settings change one knob, at values spread over its range; half change all, as a
  /// Latin hypercube: each knob takes each part of its range once.
  std::vector<Point> first_generation() {
    const double share = first_share * static_cast<double>(options_.budget);
    const std::size_t size =
        std::max<std::size_t>(8, static_cast<std::size_t>(share / race_cost()));
    const std::vector<Dimension>& dimensions = problem_.space.dimensions;
    std::vector<Point> points;
    const std::size_t levels = std::max<std::size_t>(2, size / (2 * dimensions.size()));
    for (std::size_t d = 0; d < dimensions.size(); ++d) {
      for (std::size_t k = 0; k < levels; ++k) {
        Point point = problem_.space.unchanged();
        point[d] = dimensions[d].value_at(static_cast<double>(k) / static_cast<double>(levels - 1));
        add_new(point, points);
      }
    }
    const std::size_t rest = size / 2;
    std::vector<Point> cube(rest, problem_.space.unchanged());
    for (std::size_t d = 0; d < dimensions.size(); ++d) {
      std::vector<std::size_t> parts(rest);
      std::iota(parts.begin(), parts.end(), std::size_t{0});
      for (std::size_t k = rest; k > 1; --k) std::swap(parts[k - 1], parts[random_.below(k)]);
      for (std::size_t k = 0; k < rest; ++k) {
        const double part = static_cast<double>(parts[k]) + random_.unit();
        cube[k][d] = dimensions[d].value_at(part / static_cast<double>(rest));
      }
    }
    for (const Point& point : cube) add_new(point, points);
    return points;
  }

  /// Children of the most promising settings: knobs of two parents, some of them moved by steps
  /// that become shorter as the budget is used up, some set back.
  std::vector<Point> bred() {
    const std::vector<Point> best = promising(population_, options_.seeds.count, parents);
    std::vector<Point> points;
    if (best.empty()) return points;
    for (std::size_t tries = 0; tries < children * most_attempts && points.size() < children;
         ++tries) {
      // The minimum of two draws: the more promising, the more children.
      const Point& one = best[std::min(random_.below(best.size()), random_.below(best.size()))];
      const Point& other = best[random_.below(best.size())];
      add_new(child(one, other), points);
    }
    return points;
  }

  Point child(const Point& one, const Point& other) {
    const std::vector<Dimension>& dimensions = problem_.space.dimensions;
    const double reach = 0.5 - 0.4 * std::min(used(), 1.0);
    Point point = one;
    const bool crossed = random_.unit() < 0.5;
    const std::size_t sure = random_.below(dimensions.size());
    for (std::size_t d = 0; d < dimensions.size(); ++d) {
      if (crossed && random_.unit() < 0.5) point[d] = other[d];
      if (d != sure && random_.unit() * static_cast<double>(dimensions.size()) >= 1) continue;
      const double position = dimensions[d].position_of(point[d]) + reach * random_.step();
      point[d] = random_.unit() < 0.2 ? dimensions[d].unchanged : dimensions[d].value_at(position);
    }
    return point;
  }

  /// The first `most` of `points` by their costs under the first `runs` seeds.
  std::vector<Point> promising(const std::vector<Point>& points, std::size_t runs,
                               std::size_t most) const {
    std::vector<Cost> costs;
    for (const Point& point : points) costs.push_back(archive_.cost(point, seeds(runs)));
    std::vector<Point> chosen;
    for (const std::size_t k : by_promise(costs)) {
      if (chosen.size() < most) chosen.push_back(points[k]);
    }
    return chosen;
  }

  bool race(std::vector<Point> points) {
    ++result_.generations;
    for (const std::size_t level : levels_) {
      const bool complete = archive_.extend(points, seeds(level));
      if (!complete) return false;
      std::erase_if(points, [&](const Point& point) { return rejects(point, seeds(level)); });
      if (level == levels_.back()) break;
      points = promising(points, level, (points.size() + 1) / 2);
    }
    for (const Point& point : points) enter(point);
    return watch_front(population_, options_.seeds).has_value();
  }

  bool rejects(const Point& point, Seeds seeds) {
    const auto broken = broken_in(archive_.outcomes(point, seeds));
    if (broken.empty()) return false;
    ++result_.rejected;
    for (const std::string_view id : broken) ++result_.rejected_by[std::string{id}];
    return true;
  }

  void enter(const Point& point) {
    result_.finalists.push_back(archive_.cost(point, options_.seeds));
    population_.push_back(point);
  }

  /// If the first race was interrupted, there are no finalists yet: then the front is that of all
  /// who have finished its first stage. False: it was interrupted.
  bool conclude() {
    result_.basis = options_.seeds;
    std::vector<Point> candidates = population_;
    if (!result_.finished && population_.size() <= 1) {
      result_.basis = seeds(levels_.front());
      candidates.assign(seen_.begin(), seen_.end());
    }
    auto front = watch_front(candidates, result_.basis);
    const bool complete = front.has_value();
    result_.front = complete ? *std::move(front) : front_of(candidates, result_.basis);
    return complete;
  }

  /// The front of those that keep everything; who does not is taken out of `candidates`, but for
  /// the unchanged setting, from which others are bred. Whoever is dominated by a setting that
  /// keeps everything need not be watched. Nothing: it was interrupted.
  std::optional<std::vector<Point>> watch_front(std::vector<Point>& candidates, Seeds basis) {
    for (;;) {
      std::vector<Point> front = front_of(candidates, basis);
      if (!archive_.watch(front, basis)) return std::nullopt;
      bool all_keep = true;
      for (const Point& point : front) {
        if (archive_.keeps(point, basis)) continue;
        all_keep = false;
        if (point == problem_.space.unchanged()) continue;
        rejects(point, basis);
        std::erase(candidates, point);
      }
      if (all_keep) return front;
    }
  }

  /// Of those that are known not to break anything.
  [[nodiscard]] std::vector<Point> front_of(const std::vector<Point>& candidates,
                                            Seeds basis) const {
    std::vector<Point> kept;
    std::vector<Cost> costs;
    for (const Point& point : candidates) {
      const std::vector<Outcome> outcomes = archive_.outcomes(point, basis);
      if (outcomes.size() < basis.count || !broken_in(outcomes).empty()) continue;
      // Of what was cut nothing is known that another could be held against.
      if (std::ranges::any_of(outcomes, [](const Outcome& one) { return one.cut.has_value(); }) &&
          std::isinf(cost_of(outcomes).completion))
        continue;
      kept.push_back(point);
      costs.push_back(archive_.cost(point, basis));
    }
    std::vector<Point> front;
    for (const std::size_t k : pareto_front(costs)) front.push_back(kept[k]);
    return front;
  }

  const Problem& problem_;
  Archive& archive_;
  const SearchOptions& options_;
  Random random_;
  std::vector<std::size_t> levels_;  ///< runs of a setting at each stage of a race
  std::set<Point> seen_;
  std::vector<Point> population_;
  SearchResult result_;
};

}  // namespace

SearchResult search(const Problem& problem, Archive& archive, const SearchOptions& options) {
  return Search{problem, archive, options}.run();
}

}  // namespace stormproof::tune
