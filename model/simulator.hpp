// Runs a scenario: one deterministic trajectory, to the nanosecond, from the start of the first
// participant until discovery is complete (or beyond, with `run_until: time_limit`), the time limit
// has passed or the caller stops it.
#pragma once

#include <functional>

#include "model/mutation.hpp"
#include "model/probe.hpp"
#include "model/run_result.hpp"
#include "model/scenario.hpp"

namespace stormproof::model {

/// Where a run stands; given to `RunOptions::on_progress`.
struct Progress {
  Nanoseconds now;
  std::uint64_t events = 0;
  std::uint64_t missing = 0;   ///< required deliveries that have not happened
  std::uint64_t required = 0;  ///< F
};

struct RunOptions {
  Probe* probe = nullptr;              ///< observer, or none
  const Mutation* mutation = nullptr;  ///< a deliberate mistake in the rules, or none
  std::uint64_t max_events = 0;  ///< interrupts the run after so many events; 0: no such limit
  /// Called every `progress_interval` events; returning false interrupts the run.
  std::function<bool(const Progress&)> on_progress;
  static constexpr std::uint64_t progress_interval = 1U << 14U;
};

/// Simulates `scenario`. The scenario must be valid: what `read_scenario` accepts is.
[[nodiscard]] RunResult simulate(const Scenario& scenario, const RunOptions& options = {});

struct ImplementationMaker;
/// The same with an implementation of one's own, whatever the profile names.
[[nodiscard]] RunResult simulate(const Scenario& scenario, const RunOptions& options,
                                 const ImplementationMaker& maker);

}  // namespace stormproof::model
