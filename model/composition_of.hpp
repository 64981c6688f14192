// The composition that a profile's implementation executes, as data.
#pragma once

#include "fsm/composition/composition_info.hpp"
#include "model/dds_profile.hpp"

namespace stormproof::model {

[[nodiscard]] const fsm::composition::CompositionInfo& composition_of(const DdsProfile& dds);
[[nodiscard]] const fsm::composition::CompositionInfo& composition_of(ImplementationKind kind);

}  // namespace stormproof::model
