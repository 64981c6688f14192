// Runs the scenarios of all configurations, with sampled schedules where they have one, on all
// cores.
#pragma once

#include <array>
#include <cstdint>
#include <functional>
#include <span>
#include <vector>

#include "checker/evidence/coverage/observation.hpp"
#include "model/scenario.hpp"

namespace stormproof::prediction {

/// One scenario to predict.
struct Case {
  model::Scenario scenario;
  double loss = 0;  ///< probability of each packet, drawn anew in each sample

  /// Whether samples differ; otherwise one run is enough.
  [[nodiscard]] bool sampled() const { return scenario.deployment.schedule || loss > 0; }
};

/// What the runs of a case yielded, one entry a run in the order of seeds.
struct Prediction {
  /// By measure. A run that did not complete counts as infinite in all of them: its time and its
  /// counts would only be lower bounds.
  std::array<std::vector<double>, measure_count> values;
  std::size_t incomplete = 0;
};

struct PredictOptions {
  std::size_t samples = 12;
  std::uint64_t first_seed = 0;  ///< sample k of every case has seed first_seed + k
  std::size_t threads = 0;       ///< 0: as many as the machine has cores
  /// Called from one thread at a time; returning false stops all runs.
  std::function<bool(std::size_t finished, std::size_t all)> on_progress;
};

struct Predictions {
  std::vector<Prediction>
      cases;              ///< one for each case; without values if none of its runs finished
  bool finished = false;  ///< whether all runs did, or they were stopped
};
[[nodiscard]] Predictions predict(std::span<const Case> cases, const PredictOptions& options);

/// Ascending numbers of the packets that are lost, each packet with this probability, for the first
/// two million packets of a run. The same seed gives the same numbers on every machine.
[[nodiscard]] std::vector<std::uint64_t> draw_losses(double probability, std::uint64_t seed);

}  // namespace stormproof::prediction
