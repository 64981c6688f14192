// A bound on the time that discovery takes which holds for all parameters, though it is not tight.
// The argument stands in completion.cpp; the tight bound, in a region, is a matter of proof.
#pragma once

#include <cstdint>

#include "model/dds_profile.hpp"
#include "model/units.hpp"

namespace stormproof::props {

/// From the start of both ends of a relation (Fast DDS: and the creation of all endpoints) to the
/// reception of its last descriptor, if no packet takes longer than `delay` and at most `losses`
/// are lost.
[[nodiscard]] model::Nanoseconds completion_bound(const model::DdsProfile& dds,
                                                  model::Nanoseconds delay, std::uint64_t losses);

}  // namespace stormproof::props
