// Runs one scenario under many schedules, on all cores. A storm is chaotic: a participant that
// starts a microsecond later changes every count, so what can be predicted is the distribution over
// schedules.
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "checker/engines/exact/health.hpp"
#include "checker/experiments/trials/launch_plan.hpp"
#include "checker/experiments/trials/runner.hpp"
#include "model/counts.hpp"
#include "model/run_result.hpp"
#include "model/scenario.hpp"

namespace stormproof::trials {

/// What is kept of one sampled run.
struct Sample {
  std::uint64_t seed = 0;  ///< of its schedule
  model::RunEnd end{};
  std::optional<model::Nanoseconds> discovery_time;
  model::Counts counts;
  std::uint64_t user_control = 0;
  std::uint64_t events = 0;
  exact::RunHealth health{};
};

/// What runs that know their `health` were like together; absent if there are none.
template <class Run>
[[nodiscard]] std::optional<exact::Outlook> outlook_of(const std::vector<Run>& runs) {
  if (runs.empty()) return std::nullopt;
  std::vector<exact::RunHealth> all;
  all.reserve(runs.size());
  for (const Run& run : runs) all.push_back(run.health);
  return exact::Outlook{std::move(all)};
}

/// Samples of a scenario whose start times are drawn, unless somebody wants another number.
inline constexpr std::size_t usual_samples = 12;

struct SampleOptions {
  std::size_t samples = 1;
  std::uint64_t first_seed = 0;       ///< sample k draws its schedule from seed first_seed + k
  model::Nanoseconds start_jitter{};  ///< each participant starts up to this much later
  std::size_t threads = 0;            ///< 0: as many as the machine has cores
  Progress on_progress;
};

/// The run of `scenario` under one seed, started by `plan` if there is one, which must not wait;
/// nothing if it was stopped.
[[nodiscard]] std::optional<Sample> sample_run(Runner& runner, const model::Scenario& scenario,
                                               std::uint64_t seed, model::Nanoseconds start_jitter,
                                               const std::optional<launch::Plan>& plan = {});

/// The sampled runs in the order of their seeds; those that were stopped are left out. The
/// deployment must have a schedule or a jitter, or `samples` be 1: then the scenario runs as it is.
[[nodiscard]] std::vector<Sample> sample_runs(const model::Scenario& scenario,
                                              const SampleOptions& options);

}  // namespace stormproof::trials
