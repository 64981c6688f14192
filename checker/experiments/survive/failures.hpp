// The failures that a fleet has to survive, as lives of a deployment: whose network is away, who is
// killed, leaves or is replaced, and for how long. Which lengths are tried follows from the lease:
// an outage that ends before anybody is forgotten costs little, so there are some around it.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "model/scenario.hpp"

namespace stormproof::survive {

enum class Kind : std::uint8_t {
  network_at_start,  ///< the access point, in the middle of the first discovery
  network,           ///< the access point: no host hears another
  host,              ///< one host, out of range or roaming
  process_killed,    ///< a process; another one comes in its place
  process_left,      ///< the same, and it says that it goes
  process_gone,      ///< a process that never comes back
  server_killed,     ///< a Discovery Server, which comes back under its own name; then a process
                     ///< joins, of which all others have to hear
  unseen_death       ///< a process that never comes back dies while the server is away
};
/// "network_at_start", …
[[nodiscard]] const char* name_of(Kind kind);
/// "the network, while everybody starts", …
[[nodiscard]] const char* words_of(Kind kind);

struct Failure {
  Kind kind{};
  model::Nanoseconds length;  ///< how long it is away; 0: for ever

  bool operator==(const Failure&) const = default;
};

/// All that can happen to the scenario, each kind by ascending length. `lengths`: those of whoever
/// is away; empty: from 0.2 to 120 s, and some around the lease.
[[nodiscard]] std::vector<Failure> failures_of(const model::Scenario& scenario,
                                               const std::vector<model::Nanoseconds>& lengths);

/// The scenario with the failure, which begins at `at`; it happens to the last host, and to the
/// first participant of that.
[[nodiscard]] model::Scenario with(const Failure& failure, model::Nanoseconds at,
                                   model::Scenario scenario);

/// "the network for 30.00 s".
[[nodiscard]] std::string words_of(const Failure& failure);

}  // namespace stormproof::survive
