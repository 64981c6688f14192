// The oracle of `implementation: cyclone`: a third, deliberately naive simulator, of the rules in
// specs/guide/cyclone.md. Like the other oracles it exists to be compared with the product on any
// scenario, and shares nothing with it but the plain input structs.
#pragma once

#include <cstdint>

#include "model/scenario.hpp"
#include "tests/oracle/oracle.hpp"

namespace stormproof::oracle {

/// The counts and the missing descriptors are those of cross-host pairs.
struct CycloneOutcome : Outcome {
  std::int64_t user_control = 0;
  std::int64_t forgotten = 0;  ///< how often a lease ended
};

/// Runs the scenario as `run` does. Takes the profile for one of `implementation: cyclone`,
/// whatever it says.
/// With a life, of which it knows leases, outages, deaths and successors, all is counted until
/// discovery was complete for the last time, and the run goes on until the time limit.
/// Throws std::invalid_argument if the deployment has no cross-host pair, or a participant is done
/// or ready before it starts, or starts before it opens.
[[nodiscard]] CycloneOutcome run_cyclone(const model::Scenario& scenario, const EventLog& log = {},
                                         CycloneMistake mistake = CycloneMistake::none,
                                         std::uint64_t max_events = 0);

}  // namespace stormproof::oracle
