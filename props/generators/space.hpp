// Which random scenarios are drawn, and the drawing itself, as a function of a seed and a size.
// Apart from scenarios.hpp, so that whoever needs no shrinking needs no RapidCheck.
#pragma once

#include <cstdint>
#include <optional>

#include "model/scenario.hpp"

namespace stormproof::props {

/// Which scenarios are drawn. The limits keep a run short; a law that runs a scenario several times
/// lowers them.
struct ScenarioSpace {
  std::optional<model::ImplementationKind> implementation = {};  ///< absent: any engines know
  std::optional<model::ServiceKind> service = {};                ///< absent: both
  std::uint32_t max_participants = 6;                            ///< at least 2
  std::uint32_t max_endpoints = 6;  ///< user endpoints of a participant, of each kind
  bool losses = true;
  model::Nanoseconds max_time_limit{20'000'000'000};  ///< at least 1 ms
  std::optional<model::RunUntil> run_until = {};      ///< absent: mostly until completion
};

/// The scenario of this seed, the same on every machine; it is what `read_scenario` accepts. `size`
/// (0 … 100) is how far it goes towards the largest deployment.
[[nodiscard]] model::Scenario draw_scenario(std::uint64_t seed, int size,
                                            const ScenarioSpace& space = {});

}  // namespace stormproof::props
