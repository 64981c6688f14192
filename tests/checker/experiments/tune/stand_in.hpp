// A problem whose optimum is known: two or more knobs from 0 to 1000, and costs that are a formula
// of them, with noise that depends on setting and seed as a storm's chance does.
#pragma once

#include <algorithm>
#include <cmath>
#include <functional>
#include <string>

#include "checker/experiments/tune/outcome.hpp"

namespace stormproof::tune {

constexpr model::Nanoseconds stand_in_limit{1'000'000'000};

inline Space space_of_knobs(std::size_t count, std::int64_t unchanged) {
  Space space;
  for (std::size_t d = 0; d < count; ++d) {
    Dimension dimension;
    dimension.key = "knob." + std::to_string(d);
    dimension.minimum = 0;
    dimension.maximum = 1'000;
    dimension.unchanged = unchanged;
    dimension.unit = model::config::NumericKnob::Unit::bytes;
    space.dimensions.push_back(dimension);
  }
  return space;
}

/// Between -1 and 1, the same for the same setting and seed.
inline double noise(const Point& point, std::uint64_t seed) {
  std::uint64_t hash = seed * 0x9E3779B97F4A7C15U + 1;
  for (const std::int64_t value : point) {
    hash = (hash ^ static_cast<std::uint64_t>(value)) * 0xBF58476D1CE4E5B9U;
    hash ^= hash >> 29U;
  }
  return static_cast<double>(hash % 2'001) / 1'000.0 - 1;
}

inline Outcome outcome_of(double completion, double messages) {
  Outcome outcome;
  outcome.completion = model::Nanoseconds{std::llround(completion)};
  outcome.counts.heartbeat = static_cast<std::uint64_t>(std::llround(std::max(messages, 0.0)));
  return outcome;
}

using Formula = std::function<Cost(const Point&)>;

/// Costs by `formula`, each run up to `spread` (relative) away from it.
inline Problem problem_of(Space space, Formula formula, double spread) {
  Problem problem;
  problem.space = std::move(space);
  problem.run = [formula = std::move(formula), spread](
                    const Point& point, std::uint64_t seed,
                    model::Nanoseconds) -> std::optional<Outcome> {
    const Cost cost = formula(point);
    const double chance = 1 + spread * noise(point, seed);
    return outcome_of(cost.completion * chance, cost.messages * chance);
  };
  return problem;
}

}  // namespace stormproof::tune
