// storm.free-threshold from the rules: if nothing is lost and no packet takes longer than
// min(τ_A, τ_I), no descriptor of the paper's writer is ever repaired, for all timers, any number
// of descriptors and readers, and HEARTBEATs at any times.
#pragma once

#include "checker/engines/bounds/check_request.hpp"

namespace stormproof::tables {

/// Whether the certificate is about a profile: DATA is pushed, both sides open at once, and initial
/// ACKNACKs come and ask.
[[nodiscard]] bool has_free_certificate(const model::DdsProfile& dds);

/// With the mutant's mistakes. `more`: by how many ns more than the threshold packets may take, to
/// show that it is one.
[[nodiscard]] props::Finding free_certificate(const checker::CheckRequest& request, int more = 0);

}  // namespace stormproof::tables
