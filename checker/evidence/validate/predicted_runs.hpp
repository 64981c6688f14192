// Runs the captured deployment in the model: starts as captured, creation times drawn from what the
// capture proves, packets lost with the stated probability. The same seed gives the same run on
// every machine.
#pragma once

#include <cstdint>
#include <vector>

#include "checker/evidence/validate/captured_deployment.hpp"
#include "checker/evidence/validate/figures.hpp"
#include "checker/evidence/validate/limiting.hpp"
#include "checker/evidence/validate/observation.hpp"
#include "checker/experiments/trials/runner.hpp"
#include "model/run_result.hpp"
#include "model/scenario.hpp"

namespace stormproof::validate {

struct PredictedRun {
  std::uint64_t seed = 0;
  bool complete = false;  ///< otherwise its figures are lower bounds
  Tally tally{};          ///< at its cut; of an incomplete run, at the end and without completion
  Growth growth{};        ///< a run that is over keeps its counts
  Shares shares{};        ///< what it waited for
};

struct Sampling {
  std::size_t samples = 24;
  std::uint64_t first_seed = 0;  ///< sample k has seed first_seed + k
  std::size_t threads = 0;       ///< 0: as many as the machine has cores
  double loss = 0;               ///< probability of each packet
  trials::Progress on_progress;
};

struct Predicted {
  std::vector<PredictedRun> runs{};  ///< in the order of seeds; stopped ones are left out
  std::size_t wanted = 0;            ///< 1 if nothing is drawn
  Sizes sizes{};                     ///< of the run with the first seed
};

/// How many steps of the observation's growth the model's has: a slower model is shown until it has
/// taken this many times as long.
inline constexpr std::size_t most_growth = 4;

/// Whether two seeds differ in anything.
[[nodiscard]] bool is_drawn(const model::Scenario& scenario, const CapturedDeployment& deployment,
                            double loss);

/// The scenario with the times and losses of `seed`.
[[nodiscard]] model::Scenario draw(const model::Scenario& scenario,
                                   const CapturedDeployment& deployment, double loss,
                                   std::uint64_t seed);

[[nodiscard]] Predicted predict(const model::Scenario& scenario, const Observation& observation,
                                const Sampling& sampling);

}  // namespace stormproof::validate
