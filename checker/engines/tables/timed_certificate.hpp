// What all certificates over a timed descriptor have in common: what is assumed, and candidates of
// what else holds.
#pragma once

#include "checker/engines/tables/certificate.hpp"
#include "checker/engines/tables/timed_descriptor.hpp"

namespace stormproof::tables {

/// States what the timed system takes as given.
void assume_in_time(Proof& proof);

/// A certificate of nothing yet: the system that moves, what is given of the unknowns, and
/// candidates.
[[nodiscard]] Certificate certificate_in_time(const TimedDescriptor& descriptor,
                                              const Moving& moving);
/// Adds an assumption about the unknowns.
void give(Certificate& certificate, std::string words, const Expr& holds);

}  // namespace stormproof::tables
