// Directed runs at check time: the boundary points of a theorem are run through the machines and
// held against the encoding, so that a proof about rules that no longer hold is noticed; and a
// counterexample is accepted only if the property's monitor objects to its run.
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "checker/engines/bounds/check_request.hpp"
#include "checker/engines/timeline/relation_timeline.hpp"

namespace stormproof::timeline {

/// A schedule at the border of a theorem.
struct BoundaryPoint {
  std::string name;
  Setting setting;  ///< under the rules that the theorem is about
  Director director;
  /// What the closed form says about the run, or nothing if it agrees; asked after the encoding.
  std::function<std::string(const Prediction&)> expected;
};

/// The profile of the scenario with what the encodings leave out set to what does not matter:
/// periodic single timers, relations that open at once, no HEARTBEATs because of other relations.
[[nodiscard]] model::DdsProfile encoded_profile(const model::DdsProfile& dds);

/// Runs every point under the request's mutant, if it has one. A point at which run, encoding and
/// closed form differ makes the finding disputed, or violated by the mutant, with the run as
/// counterexample. A line says how many agree, and with what else than the scenario's profile they
/// run.
void hold_against_runs(const std::vector<BoundaryPoint>& points, std::string_view property,
                       const checker::CheckRequest& request, props::Finding& finding);

/// The counterexample that this scenario's run is, if the property's monitor objects to it.
[[nodiscard]] std::optional<props::Counterexample> confirmed_counterexample(
    std::string_view property, const model::Scenario& scenario,
    const model::Mutation* mutation = nullptr);

}  // namespace stormproof::timeline
