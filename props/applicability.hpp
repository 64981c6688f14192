// Which properties say something about which implementation. Most are about descriptors and timers
// that the paper's and Fast DDS's writers have; a verdict about them would say nothing of another
// writer.
#pragma once

#include <string_view>

#include "model/dds_profile.hpp"

namespace stormproof::props {

/// Why the property does not apply to the implementation, as a clause; empty if it does.
[[nodiscard]] std::string_view why_not_applicable(std::string_view property,
                                                  model::ImplementationKind implementation);

}  // namespace stormproof::props
