// The worst case of live.completion, as a schedule: for any parameters, the delays and losses with
// which the paper's writer needs exactly B(k). It shows that the bound cannot be improved, and as
// it runs through the machines it ties the proof to them.
#pragma once

#include "checker/engines/bounds/completion_bound.hpp"
#include "checker/engines/timeline/directed_run.hpp"

namespace stormproof::timeline {

/// How the worst case goes: the director of a relation with these circumstances and k losses.
/// `phase` of the setting must be that of `worst_phase` if the timer does not start with the
/// relation.
[[nodiscard]] Director worst_completion(const model::SedpProfile& sedp,
                                        const Circumstances& circumstances, unsigned losses);

/// When the timer must expire first, after the opening, so that the first lost repair costs most.
[[nodiscard]] model::Nanoseconds worst_phase(const model::SedpProfile& sedp,
                                             const Circumstances& circumstances);

/// Whether the worst case attains the bound: no initial ACKNACK may ask, or cause one more
/// HEARTBEAT, before the HEARTBEAT of the opening has been seen, and both sides must open at once.
[[nodiscard]] bool is_attained(const model::SedpProfile& sedp, model::Nanoseconds delta);

}  // namespace stormproof::timeline
