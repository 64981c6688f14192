// What a seed means: the circumstances of one run, which depend on the seed and the deployment
// alone, so that two settings under the same seed start alike and can be compared pair by pair.
#pragma once

#include <cstdint>

#include "model/scenario.hpp"

namespace stormproof::trials {

/// `scenario` with start times drawn from its deployment's schedule, if it has one, and each
/// participant started up to `start_jitter` later; its losses, if it has any, are those of the
/// seed. The same on every machine.
[[nodiscard]] model::Scenario under_seed(model::Scenario scenario, std::uint64_t seed,
                                         model::Nanoseconds start_jitter = {});

/// The participant does everything so much later, or earlier if it is negative, but nothing before
/// the run.
void start_later(model::Participant& participant, model::Nanoseconds later);

}  // namespace stormproof::trials
