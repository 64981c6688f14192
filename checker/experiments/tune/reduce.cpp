// All points go one step at a time, so that the runs of a step fill all cores. Every comparison is
// with the point as it came, not with the step before: many small losses would add up.
#include "checker/experiments/tune/reduce.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "checker/experiments/statistics/completion.hpp"

namespace stormproof::tune {

namespace {

double messages_of(const Outcome& outcome) { return static_cast<double>(outcome.counts.total()); }

/// As far as it is known: what was cut takes longer.
double completion_of(const Outcome& outcome) {
  return statistics::completion_ns(outcome.cut ? outcome.cut : outcome.completion);
}

/// Nothing takes less than 1 ns, or one message. NaN if both are unreached.
double logarithm_of_ratio(double candidate, double reference) {
  return std::log(std::max(candidate, 1.0) / std::max(reference, 1.0));
}

/// What one costs beside the other. What was cut costs at least so much.
void add(statistics::PairedDifferences& pairs, const Outcome& one, double costs,
         const Outcome& other, double other_costs) {
  constexpr double infinity = std::numeric_limits<double>::infinity();
  const double ratio = logarithm_of_ratio(costs, other_costs);
  if (one.cut && other.cut) {
    pairs.add_between(-infinity, infinity);
  } else if (one.cut) {
    pairs.add_between(ratio, infinity);
  } else if (other.cut) {
    pairs.add_between(-infinity, ratio);
  } else {
    pairs.add(ratio);
  }
}

/// A changed value moves back by a half of the way, a quarter if that is too far, an eighth, and no
/// further.
constexpr std::size_t most_failures = 3;
/// How often a value moves back at most.
constexpr std::size_t most_moves = 4;

/// A point on its way.
struct Journey {
  enum class Stage : std::uint8_t { setting_back, moving_back, arrived };
  Point original;
  Point now;
  Stage stage = Stage::setting_back;
  std::vector<std::size_t> moves, failures;  ///< of moving back, by dimension
};

/// A step of a journey: one dimension gets another value.
struct Step {
  std::size_t dimension = 0;
  Point to;
};

/// With one change less, each of them; or with one value moved back.
std::vector<Step> steps_of(const Space& space, const Journey& journey) {
  std::vector<Step> steps;
  for (const std::size_t d : space.changes(journey.now)) {
    const Dimension& dimension = space.dimensions[d];
    Step step{d, journey.now};
    if (journey.stage == Journey::Stage::setting_back) {
      step.to[d] = dimension.unchanged;
    } else {
      if (journey.failures[d] == most_failures || journey.moves[d] == most_moves) continue;
      const double from = dimension.position_of(journey.now[d]);
      const double way = dimension.position_of(dimension.unchanged) - from;
      const double share = std::pow(0.5, static_cast<double>(journey.failures[d] + 1));
      step.to[d] = dimension.value_at(from + share * way);
      if (step.to[d] == journey.now[d] || step.to[d] == dimension.unchanged) continue;
    }
    steps.push_back(std::move(step));
  }
  return steps;
}

class Reducer {
 public:
  Reducer(const Problem& problem, Archive& archive, Seeds seeds, double least, double early)
      : problem_{problem}, archive_{archive}, seeds_{seeds}, least_{least}, early_{early} {
    if (early_ >= 1) return;
    for (std::size_t runs = statistics::fewest_pairs(early_); runs < seeds_.count; runs *= 2) {
      looks_.push_back(runs);
    }
  }

  std::optional<std::vector<Point>> run(const std::vector<Point>& points) {
    std::vector<Journey> journeys;
    for (const Point& point : points) {
      const std::vector<std::size_t> none(point.size(), 0);
      journeys.push_back({point, point, Journey::Stage::setting_back, none, none});
    }
    if (!archive_.extend(points, seeds_) || !archive_.watch(points, seeds_)) return std::nullopt;
    const auto is_on_its_way = [](const Journey& journey) {
      return journey.stage != Journey::Stage::arrived;
    };
    while (std::ranges::any_of(journeys, is_on_its_way)) {
      std::vector<Candidate> candidates;
      for (const Journey& journey : journeys) {
        if (!is_on_its_way(journey)) continue;
        for (Step& step : steps_of(problem_.space, journey)) {
          if (is_valid(step.to)) candidates.push_back({std::move(step.to), &journey.original});
        }
      }
      if (!race(std::move(candidates))) return std::nullopt;
      for (Journey& journey : journeys) {
        if (is_on_its_way(journey) && !go_on(journey)) return std::nullopt;
      }
    }
    std::vector<Point> reduced;
    for (const Journey& journey : journeys) reduced.push_back(journey.now);
    return reduced;
  }

 private:
  struct Candidate {
    Point point;
    const Point* original;
  };

  /// Makes the runs of the candidates, but for those that are given up; they have the first ones.
  bool race(std::vector<Candidate> candidates) {
    const auto extend = [&](std::size_t runs) {
      std::vector<Point> points;
      for (const Candidate& candidate : candidates) points.push_back(candidate.point);
      return archive_.extend(points, {seeds_.first, runs});
    };
    for (const std::size_t runs : looks_) {
      if (!extend(runs)) return false;
      std::erase_if(candidates, [&](const Candidate& candidate) {
        return is_given_up(candidate, {seeds_.first, runs});
      });
    }
    return extend(seeds_.count);
  }

  [[nodiscard]] bool is_given_up(const Candidate& candidate, Seeds part) const {
    const Difference change = difference(archive_.outcomes(candidate.point, part),
                                         archive_.outcomes(*candidate.original, part), early_);
    return (change.completion.confidence >= early_ && is_clearly_more(change.completion, least_)) ||
           (change.messages.confidence >= early_ && is_clearly_more(change.messages, least_));
  }

  [[nodiscard]] bool is_valid(const Point& point) const {
    return !problem_.is_valid || problem_.is_valid(point);
  }

  /// Takes the step that costs least, if one may be taken. The next stage begins if none may, or
  /// none is left. False: it was interrupted.
  bool go_on(Journey& journey) {
    const bool moves_back = journey.stage == Journey::Stage::moving_back;
    const auto refuse = [&](const Step& step) {
      if (moves_back) ++journey.failures[step.dimension];
    };
    const std::vector<Step> steps = steps_of(problem_.space, journey);
    std::vector<std::pair<Cost, const Step*>> good;
    for (const Step& step : steps) {
      if (is_valid(step.to) && is_as_good(step.to, journey.original)) {
        good.emplace_back(archive_.cost(step.to, seeds_), &step);
      } else {
        refuse(step);
      }
    }
    std::ranges::stable_sort(good, is_sooner, &std::pair<Cost, const Step*>::first);
    // Only what is to be taken is watched.
    for (const auto& [cost, step] : good) {
      if (!archive_.watch({step->to}, seeds_)) return false;
      if (!keeps_as(step->to, journey.original)) {
        refuse(*step);
        continue;
      }
      if (moves_back) ++journey.moves[step->dimension];
      journey.now = step->to;
      return true;
    }
    if (!moves_back) {
      journey.stage = Journey::Stage::moving_back;
    } else if (steps.empty()) {
      journey.stage = Journey::Stage::arrived;
    }
    return true;
  }

  [[nodiscard]] bool keeps_as(const Point& candidate, const Point& original) const {
    return archive_.keeps(candidate, seeds_) || !archive_.keeps(original, seeds_);
  }

  /// What was given up has not got all runs.
  [[nodiscard]] bool is_as_good(const Point& candidate, const Point& original) const {
    if (archive_.outcomes(candidate, seeds_).size() < seeds_.count) return false;
    if (!keeps_as(candidate, original)) return false;
    const Difference change =
        difference(archive_.outcomes(candidate, seeds_), archive_.outcomes(original, seeds_));
    return !is_clearly_more(change.completion, least_) && !is_clearly_more(change.messages, least_);
  }

  const Problem& problem_;
  Archive& archive_;
  Seeds seeds_;
  double least_;
  double early_;
  std::vector<std::size_t> looks_;  ///< after how many runs a step can be given up
};

}  // namespace

Difference difference(const std::vector<Outcome>& candidate, const std::vector<Outcome>& reference,
                      double confidence) {
  statistics::PairedDifferences completion;
  statistics::PairedDifferences messages;
  for (std::size_t k = 0; k < std::min(candidate.size(), reference.size()); ++k) {
    const Outcome& one = candidate[k];
    const Outcome& other = reference[k];
    add(completion, one, completion_of(one), other, completion_of(other));
    add(messages, one, messages_of(one), other, messages_of(other));
  }
  if (candidate.size() == 1) return {completion.fact(), messages.fact()};
  return {completion.shift(confidence), messages.shift(confidence)};
}

bool is_clearly_more(const Shift& shift, double least) {
  return shift.is_more() && shift.estimate > std::log1p(least);
}

bool is_clearly_less(const Shift& shift, double least) {
  return shift.is_less() && shift.estimate < -std::log1p(least);
}

std::optional<std::vector<Point>> reduced(std::vector<Point> points, const Problem& problem,
                                          Archive& archive, Seeds seeds, double least,
                                          double early) {
  return Reducer{problem, archive, seeds, least, early}.run(points);
}

}  // namespace stormproof::tune
