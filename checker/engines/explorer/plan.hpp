// What the explorer looks at for a scenario: which delay bound, which small scopes, and the bounds
// on times that the claims about completion and quiescence refer to.
#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "checker/engines/explorer/scope.hpp"
#include "checker/engines/explorer/search.hpp"
#include "model/scenario.hpp"

namespace stormproof::explorer {

/// The largest per-packet delay to explore.
struct DelayBound {
  model::Nanoseconds delay;
  std::string origin;  ///< one sentence: measured, or why not
};

/// The delay of `kind: constant_delay`; otherwise the largest delay from generation to reception
/// that a discovery packet has in the scenario's run, or τ_H/4 if that is less. `go_on` interrupts
/// the run.
[[nodiscard]] DelayBound delay_bound(const model::Scenario& scenario,
                                     const std::function<bool()>& go_on);

/// The scopes of one relation to explore, cheap ones first.
[[nodiscard]] std::vector<Scope> scopes(const model::Scenario& scenario, model::Nanoseconds delay);

/// Those of relations that share something, cheap ones first: of one writer with so many readers,
/// 2 … most_readers; or of both writers of a participant with one reader.
[[nodiscard]] std::vector<Scope> shared_scopes(const model::Scenario& scenario,
                                               model::Nanoseconds delay, unsigned readers,
                                               unsigned writers = 1);

/// Whether descriptors of the world come into being one after the other. There, HEARTBEATs that
/// ride in DATA are left out.
[[nodiscard]] bool creates_over_time(const model::Scenario& scenario);

/// If so: the time between the creations of two descriptors that are created after the match.
[[nodiscard]] model::Nanoseconds creation_distance(const model::Scenario& scenario);

/// How descriptors that are sent at once are split over packets. Splitting matters: what happens to
/// one packet need not happen to the other.
struct Splitting {
  /// Packets that the scenario's largest relation needs.
  std::uint32_t in_scenario = 1;
  /// With how many descriptors the explored relation needs two; absent: with none that it can have.
  std::optional<unsigned> descriptors;

  /// The explored relation cannot be split as the scenario's are.
  [[nodiscard]] bool cannot_follow() const { return in_scenario > 1 && !descriptors; }
};
[[nodiscard]] Splitting splitting(const model::Scenario& scenario);

/// How many descriptors can be put into DATA, whatever else happens, before a HEARTBEAT has to ride
/// in one. Absent if none ever rides, or if those that do are left out.
[[nodiscard]] std::optional<std::uint32_t> generated_before_heartbeat(
    const model::Scenario& scenario);

/// B(k) for the scope (checker/engines/bounds/completion_bound.hpp): no later than this after the
/// start of the world everything is received. Absent where that bound counts from something else:
/// if the two sides open apart, if descriptors are created later, and for the adaptive policy.
[[nodiscard]] std::optional<model::Nanoseconds> completion_bound(const model::DdsProfile& dds,
                                                                 const Scope& scope);

}  // namespace stormproof::explorer
