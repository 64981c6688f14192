// Runs the scenarios of all configurations, with sampled schedules where they have one, on all
// cores.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "checker/evidence/coverage/observation.hpp"
#include "checker/evidence/coverage/start_times.hpp"
#include "checker/experiments/trials/runner.hpp"
#include "model/scenario.hpp"

namespace stormproof::prediction {

/// One scenario to predict.
struct Case {
  model::Scenario scenario;
  double loss = 0;         ///< probability of each packet, drawn anew in each sample
  StartTimes starts = {};  ///< after the schedule of the scenario was drawn
  bool held = false;  ///< the scenario's limit is one of measured runs, whose counts end there, too
  Change change = {};  ///< what happens in it

  /// Whether samples differ; otherwise one run is enough.
  [[nodiscard]] bool sampled() const {
    return model::is_drawn(scenario) || loss > 0 || starts.measured() > 1;
  }
};

/// What the runs of a case yielded, one entry a run in the order of seeds.
struct Prediction {
  /// By measure. A run that did not complete counts as infinite in all of them, since its time and
  /// its counts would only be lower bounds; of a case that is held at the limit of measured runs
  /// only its time does.
  std::array<std::vector<double>, measure_count> values;
  std::size_t incomplete = 0;
  /// So many first runs have the start times of the measured ones, in their order.
  std::size_t own = 0;
};

struct PredictOptions {
  std::size_t samples = 12;
  std::uint64_t first_seed = 0;  ///< sample k of every case has seed first_seed + k
  std::size_t threads = 0;       ///< 0: as many as the machine has cores
  trials::Progress on_progress;
};

struct Predictions {
  std::vector<Prediction>
      cases;              ///< one for each case; without values if none of its runs finished
  bool finished = false;  ///< whether all runs did, or they were stopped
};
[[nodiscard]] Predictions predict(std::span<const Case> cases, const PredictOptions& options);

}  // namespace stormproof::prediction
