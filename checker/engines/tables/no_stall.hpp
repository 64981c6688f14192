// live.no-stall from the rules, for any delays, losses, numbers of descriptors, readers and
// writers. Two certificates (checker/engines/tables/certificate.hpp): that of recognition, about
// the steps of all rules without time, says that who has started goes on announcing itself, and
// that both sides of a relation open once their participants have heard of each other; that of
// live.completion says that from then on what is missing arrives if nothing is lost any more.
#pragma once

#include "checker/engines/bounds/check_request.hpp"

namespace stormproof::tables {

/// With the mutant's mistakes. A check decides it once.
[[nodiscard]] props::Finding recognition_certificate(const checker::CheckRequest& request);

}  // namespace stormproof::tables
