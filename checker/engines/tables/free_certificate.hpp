// storm.free-threshold and storm.single-copy from the rules: if nothing is lost and no packet takes
// longer than a threshold, no descriptor that the paper's writer has pushed is ever repaired, and
// so none is sent twice, for all timers, any number of descriptors and readers, and HEARTBEATs at
// any times.
#pragma once

#include <optional>

#include "checker/engines/bounds/check_request.hpp"

namespace stormproof::tables {

/// Up to which delay the certificate says something: none about pulled DATA, relations whose sides
/// do not open at once unless that makes no difference, and other writers. `constant_delay`: every
/// packet takes the same time.
[[nodiscard]] std::optional<model::Nanoseconds> certified_free(const model::DdsProfile& dds,
                                                               bool constant_delay);

/// With the mutant's mistakes, and that of packets which take `beyond` ns more than the threshold.
/// A check decides it once.
[[nodiscard]] props::Finding free_certificate(const checker::CheckRequest& request,
                                              bool constant_delay, int beyond = 0);

}  // namespace stormproof::tables
