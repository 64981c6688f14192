// What a scenario's run measures: the Δ and k that bounds and thresholds of the other engines are
// compared with.
#pragma once

#include <cstdint>
#include <optional>

#include "checker/engines/bounds/check_request.hpp"
#include "model/run_result.hpp"
#include "model/scenario.hpp"

namespace stormproof::exact {

struct Measured {
  /// Δ: no packet took longer from its emission to its reception. Packets that were under way when
  /// the run ended count with their age.
  model::Nanoseconds largest_delay;
  /// The same of those packets only that were received.
  model::Nanoseconds largest_received_delay;
  /// Of received packets that carry a descriptor for the first time.
  model::Nanoseconds largest_initial_data_delay;
  std::uint64_t lost = 0;  ///< k: packets that were not received and never will be
  std::optional<model::Nanoseconds> t_disc;  ///< absent: discovery was not completed
  model::Nanoseconds end_time;               ///< of the run
  std::uint64_t events = 0;
  std::uint64_t initial_data = 0;  ///< descriptors generated for the first time
  std::uint64_t repair_data = 0;   ///< descriptors generated again
};

/// Runs the scenario, without any mutant, until discovery is complete or its time limit has passed.
/// `request` is asked whether to go on.
[[nodiscard]] Measured measure(const model::Scenario& scenario,
                               const checker::CheckRequest& request);

}  // namespace stormproof::exact
