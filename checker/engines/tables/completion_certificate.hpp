// live.completion from the rules (checker/engines/tables/certificate.hpp), for all timers, Δ and σ,
// any number of descriptors, readers and losses: while a descriptor is missing, something is under
// way that brings it in time. With it comes a lemma: a descriptor that its writer waits for has an
// expiry within τ_H that sends to its reader. Quiescence and no-stall rest on it.
#pragma once

#include <string>

#include "checker/engines/bounds/check_request.hpp"
#include "checker/engines/tables/timed_certificate.hpp"

namespace stormproof::tables {

/// Why the certificates do not say anything about a profile; empty: they do.
[[nodiscard]] std::string not_certified(const model::DdsProfile& dds);

/// With the mutant's mistakes, and that of a bound which is too small. A check decides the bound
/// that is claimed once.
[[nodiscard]] props::Finding completion_certificate(const checker::CheckRequest& request,
                                                    const Tighter& mistake = {});

}  // namespace stormproof::tables
