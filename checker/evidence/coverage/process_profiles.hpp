// What the processes of a measured run ran, if that was not the same: the profile that stands for
// each word of a row.
#pragma once

#include <optional>

#include "checker/evidence/coverage/configuration.hpp"

namespace stormproof::prediction {

/// Gives each participant its profile. A word is what `words` says it is, a name or a map of keys;
/// otherwise the name of a profile itself, or that of a version ("Fast DDS 3.6.2": fastdds-3.6).
[[nodiscard]] std::optional<model::config::InputError> give_profiles(
    const Configuration& configuration, const ScenarioOptions& options, model::Scenario& scenario);

}  // namespace stormproof::prediction
