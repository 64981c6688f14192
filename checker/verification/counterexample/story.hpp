// A counterexample as text for a person: which property breaks and why, the deployment, the timers,
// then the events that led there, one by one, each showing only what changes.
#pragma once

#include <string>

#include "props/verdict.hpp"

namespace stormproof::counterexample {

/// Lines of at most 100 columns where words allow it. Of more than 40 relevant events, those in the
/// middle are left out and counted.
[[nodiscard]] std::string story(const props::Counterexample& counterexample);

/// "2 participants: 0 (host 0, 1 pub + 1 sub), 1 (host 1, …)": one line.
[[nodiscard]] std::string deployment_text(const model::Scenario& scenario);
/// The durations that decide when something is repaired, and what the network loses.
[[nodiscard]] std::string timers_text(const model::Scenario& scenario);

}  // namespace stormproof::counterexample
