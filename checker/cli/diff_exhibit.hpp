// `stormproof diff --exhibit ID`: an exhibit of the museum as two profiles, the knobs before its
// repair and after it, so that the comparison says whether the defect reaches a deployment.
#pragma once

#include <string>
#include <vector>

#include "checker/experiments/diff/diff.hpp"
#include "checker/experiments/museum/exhibit.hpp"

namespace stormproof::cli {

struct ExhibitSides {
  museum::Exhibit exhibit;
  model::config::TracedProfile before, after;
};

/// The sides of the exhibit `reference`: its changes on the profile `base`, or on its own if that
/// is empty, with the overrides on both. `over`: the scenario that they are for, if it is one;
/// empty otherwise.
[[nodiscard]] model::config::Result<ExhibitSides> sides_of(
    const std::string& reference, const std::string& base,
    const std::vector<std::string>& overrides, const std::string& over,
    const model::config::SpecPath& specs);

/// Whether the defect reaches what was compared, in one sentence.
[[nodiscard]] std::string reach_of(const museum::Exhibit& exhibit, const diff::DiffReport& report);

}  // namespace stormproof::cli
